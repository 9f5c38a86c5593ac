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
    std::int64_t index = 0;
    std::map<std::int64_t, std::int64_t> row_of_slave;  // by node id
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

}  // namespace balocco
