// What a checkpoint says of its model, so that jobs with other models can find what they share with it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hdf5_file.hpp"
#include "model/model.hpp"

namespace balocco {

void write_identity(const Hdf5File& file, const Model& model);

/// All of it as it was written, and where its members stand.
class ModelIdentity {
 public:
  explicit ModelIdentity(const Hdf5File& file);

  struct Element {
    std::int64_t row = 0;
    std::uint64_t nodes = 0, section = 0;  // digests (model_digest.hpp)
  };
  struct ContactPair {
    std::int64_t index = 0, places = 0;
    std::map<std::int64_t, std::vector<std::int64_t>> rows_of_home;  // of places, by the id of the node where they are kept
  };

  std::int64_t nodes() const { return static_cast<std::int64_t>(node_id_.size()); }
  std::int64_t node_id(std::int64_t row) const { return node_id_[static_cast<std::size_t>(row)]; }
  Point coordinates(std::int64_t row) const;
  /// -1: there is none, as below.
  std::int64_t row_of_node(std::int64_t id) const { return find(row_of_node_, id); }
  std::int64_t elements(const std::string& type) const;
  const Element* element(const std::string& type, std::int64_t id) const;
  /// By the id of the reference node.
  std::int64_t rigid_body(std::int64_t reference) const { return find(rigid_body_, reference); }
  const ContactPair* contact_pair(const std::string& slave, const std::string& master) const;
  /// First row of the multipliers of a constraint of that digest.
  std::int64_t constraint(std::uint64_t digest) const;

 private:
  static std::int64_t find(const std::map<std::int64_t, std::int64_t>& rows, std::int64_t id);

  std::vector<std::int64_t> node_id_;
  std::vector<double> coordinates_;
  std::map<std::int64_t, std::int64_t> row_of_node_, rigid_body_;
  std::map<std::string, std::map<std::int64_t, Element>> elements_;
  std::map<std::string, ContactPair> contact_pairs_;
  std::map<std::uint64_t, std::int64_t> constraints_;
};

/// Whether imported elements must have the sections and materials that they had.
enum class ImportedSections { same, any };

/// Numbers in the other job of what is imported.
std::int64_t id_there(const Model& model, std::int32_t node_row);
std::int64_t id_there(const Model& model, ElementRef element);

/// Of what Model::state_import names in the checkpoint at `path`.
/// @throws InputError where the checkpoint has no such nodes or elements, or others, which the message names
/// @return the way from there to here of each of StateImport::copies
std::vector<Point> refuse_other_nodes(const ModelIdentity& identity, const std::string& path, const Model& model);
void refuse_other_elements(const ModelIdentity& identity, const std::string& path, const Model& model, ImportedSections sections);
/// @return the number of the last step of the checkpoint, counted from 1, where it is finished
std::int64_t refuse_other_step(const Hdf5File& file, const std::string& path, const Model& model);
[[noreturn]] void refuse_import(const std::string& path, const Model& model, const std::string& what);

}  // namespace balocco
