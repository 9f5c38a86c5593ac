#include "model_digest.hpp"

#include "constraints/guide.hpp"
#include "elements/element_type.hpp"
#include "elements/surface_nodes.hpp"
#include "hash.hpp"

namespace balocco {

namespace {

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
    digest.add_all(table.thickness);
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

/// Every slave node has its own memory; of masters the shape may be another one.
std::string contact_pairs(const Model& model) {
  Digest digest;
  for (const auto& pair : model.contact_pairs) {
    for (const auto surface : {pair.slave, pair.master}) digest.add(std::string_view(model.surfaces[surface].name));
    digest.add_all(surface_nodes(model, model.surfaces[pair.slave]));
  }
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

void add_material(Digest& digest, const Model& model, std::int32_t row) {
  if (row < 0) return;
  const auto& material = model.materials[row];
  digest.add(std::string_view(material.law));
  digest.add_all(material.parameters);
  for (const auto& option : material.options) digest.add(std::string_view(option.name));
  if (material.expansion) digest.add(std::string_view("expands"));  // points have more history
}

}  // namespace

std::uint64_t digest_of_element(const Model& model, const ElementTable& table, std::int32_t row, std::int64_t node_shift) {
  Digest digest;
  for (int i = 0; i < table.type->nodes; ++i) {
    const auto node = table.connectivity[static_cast<std::size_t>(row) * table.type->nodes + i];
    digest.add(node >= 0 ? model.nodes.id[node] - node_shift : std::int64_t{0});
  }
  if (!table.thickness.empty()) digest.add(table.thickness[static_cast<std::size_t>(row)]);
  return digest.value();
}

std::uint64_t digest_of_section(const Model& model, const Section& section) {
  Digest digest;
  digest.add(static_cast<std::int32_t>(section.kind));
  digest.add(section.thickness);
  add_material(digest, model, section.material);
  for (const auto& ply : section.plies) add_material(digest, model, ply.material);
  if (section.initially_stressed) digest.add(std::string_view("initially stressed"));  // points have more history
  return digest.value();
}

std::uint64_t digest_of_constraint(const Model& model, const Constraint& constraint) {
  Digest digest;
  digest.add(constraint.rows());
  for (const auto node : constraint.nodes()) digest.add(model.nodes.id[node]);
  if (const auto* guide = constraint.guide())
    for (int row = 0; row < guide->rows(); ++row) digest.add(guide->component(row));
  return digest.value();
}

std::vector<std::pair<std::string, std::string>> model_digests(const Model& model) {
  return {{"nodes", nodes(model)},
          {"elements", elements(model)},
          {"sections and materials", sections_and_materials(model)},
          {"rigid bodies", rigid_bodies(model)},
          {"contact pairs", contact_pairs(model)},
          {"constraints", constraints(model)}};
}

}  // namespace balocco
