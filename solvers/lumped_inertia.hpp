// Lumped masses and rotary inertias of nodes, as the explicit loop has them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "domain.hpp"
#include "elements/element_group.hpp"
#include "elements/element_type.hpp"
#include "model/model.hpp"

namespace balocco {

struct LumpedInertia {
  std::vector<double> mass;            // per local node, MASS elements included
  std::vector<double> damping;         // per local node: sum of alpha * mass
  std::vector<double> rotary;          // per node that turns: the same about all axes; of elements with a kernel
  std::vector<double> rotary_damping;  // per node that turns: sum of alpha * that
};

/// Sums the shares of elements over all ranks: exactly, so that every copy of a node holds the same bits. Keeps its memory.
class InertiaSums {
 public:
  using Groups = std::span<const std::unique_ptr<ElementGroup>>;

  InertiaSums(const Model& model, const Communicator& communicator, const Domain& domain)
      : model_(model), communicator_(communicator), domain_(domain) {}

  /// `scaled`: with the elements' mass scales. Collective.
  /// @return the constant that rounds shares of masses
  double sum(Groups groups, bool scaled, LumpedInertia& inertia);

 private:
  enum class Kind { mass, rotary };
  double sum(Groups groups, Kind kind, bool scaled);
  template <class Visit>
  void for_each_share(Groups groups, Kind kind, bool scaled, Visit visit);

  const Model& model_;
  const Communicator& communicator_;
  const Domain& domain_;
  std::vector<double> sums_, share_;
};

/// Calls `visit(local node, mass, element)` for every MASS element whose node is on this rank.
template <class Visit>
void for_each_point_mass(const Model& model, const Domain& domain, Visit visit) {
  for (std::size_t table = 0; table < model.elements.size(); ++table) {
    const auto& elements = model.elements[table];
    if (elements.type->section != Section::Kind::mass) continue;
    for (std::int32_t row = 0; row < elements.size(); ++row) {
      const auto node = domain.local_node[elements.connectivity[row]];
      if (node >= 0) visit(node, model.sections[elements.section[row]].mass, ElementRef{static_cast<std::int32_t>(table), row});
    }
  }
}

}  // namespace balocco
