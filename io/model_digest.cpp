#include "model_digest.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string_view>

#include "constraints/constraint.hpp"
#include "elements/element_type.hpp"

namespace balocco {

namespace {

/// FNV-1a, 64 bits, of eight bytes at a time: fast, and good enough to tell two meshes of an engineer apart.
class Digest {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3ULL ^ (value_ >> 29); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
  void add(std::int32_t number) { add(static_cast<std::int64_t>(number)); }
  void add(std::string_view text) {
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    add(static_cast<std::uint64_t>(text.size()));
  }
  template <class Values>
  void add_all(const Values& values) {
    for (const auto& value : values) add(value);
  }
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

std::string nodes(const Model& model) {
  Digest digest;
  digest.add_all(model.nodes.id);
  for (const auto& point : model.nodes.coordinates) digest.add_all(point);
  return digest.text();
}

std::string elements(const Model& model) {
  Digest digest;
  for (const auto& table : model.elements) {
    digest.add(std::string_view(table.type->name));
    digest.add_all(table.id);
    digest.add_all(table.connectivity);
    digest.add_all(table.section);
  }
  return digest.text();
}

/// What decides what a history means.
std::string sections_and_materials(const Model& model) {
  Digest digest;
  for (const auto& section : model.sections) {
    digest.add(static_cast<std::int32_t>(section.kind));
    digest.add(section.material);
    digest.add(section.thickness);
    for (const auto& ply : section.plies) digest.add(ply.material);
  }
  for (const auto& material : model.materials) {
    digest.add(std::string_view(material.law));
    digest.add_all(material.parameters);
    for (const auto& option : material.options) digest.add(std::string_view(option.name));
  }
  return digest.text();
}

std::string rigid_bodies(const Model& model) {
  Digest digest;
  for (const auto& body : model.rigid_bodies) digest.add(body.reference_node);
  return digest.text();
}

std::string contact_pairs(const Model& model) {
  Digest digest;
  for (const auto& pair : model.contact_pairs)
    for (const auto surface : {pair.slave, pair.master}) digest.add(std::string_view(model.surfaces[surface].name));
  return digest.text();
}

std::string constraints(const Model& model) {
  Digest digest;
  for (const auto& constraint : make_constraints(model)) {
    digest.add(constraint->rows());
    digest.add_all(constraint->nodes());
  }
  return digest.text();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> model_digests(const Model& model) {
  return {{"nodes", nodes(model)},
          {"elements", elements(model)},
          {"sections and materials", sections_and_materials(model)},
          {"rigid bodies", rigid_bodies(model)},
          {"contact pairs", contact_pairs(model)},
          {"constraints", constraints(model)}};
}

}  // namespace balocco
