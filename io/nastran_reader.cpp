#include "nastran_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "deck/text.hpp"
#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"
#include "nastran/bulk_cards.hpp"
#include "nastran/coordinate_systems.hpp"
#include "nastran/shell_sides.hpp"

namespace balocco::nastran {

namespace {

/// Elements that are not read: a mesh without them would have holes.
const std::set<std::string> other_elements{"CBAR",   "CBEAM", "CBEND",  "CHEXA",  "CONROD", "CPENTA", "CPYRAM", "CQUAD", "CQUAD8",
                                           "CQUADR", "CROD",  "CSHEAR", "CTETRA", "CTRIA6", "CTRIAR", "CTRIAX", "CTUBE"};

struct Property {
  std::string name;
  std::int64_t material = 0;
  double thickness = 0.0;
  Location location;
};

struct Element {
  std::int64_t id = 0, property = 0;
  std::vector<std::int64_t> nodes;
  Location location;
};

class Reader {
 public:
  Reader(const std::string& text, const std::string& file_name) : data_(read_bulk_data(text, diagnostics_)) {
    model_.name = std::filesystem::path(file_name).stem().string();
    model_.files = {file_name};
    model_.heading = fmt::format("Shells of {}, in its units", std::filesystem::path(file_name).filename().string());
  }

  NastranMesh read() {
    for (const auto& card : data_.cards) first_look(card);
    for (const auto* card : grids_) grid(*card);
    if (elements_.empty() && diagnostics_.number_of_errors() == 0)
      diagnostics_.error({0, 1}, "", "no CQUAD4 and no CTRIA3, so there is no mesh; name a file that has some");
    check_elements();
    if (diagnostics_.number_of_errors() > 0) throw InputError(diagnostics_.errors(model_.files));
    build();
    auto lines = summary();
    return {std::move(model_), std::move(lines)};
  }

 private:
  void first_look(const BulkCard& card) {
    CardFields fields(card, diagnostics_);
    if (card.name == "GRID") return grids_.push_back(&card);
    if (card.name == "CQUAD4") return element(fields, 4);
    if (card.name == "CTRIA3") return element(fields, 3);
    if (card.name == "PSHELL") return property(fields);
    if (card.name == "MAT1") return material(fields);
    if (card.name == "GRDSET") {
      default_system_ = fields.integer(2, "CP", 0);
    } else if (other_elements.contains(card.name)) {
      fields.fault("this kind of element is not read, and the mesh would lack it; remove it, or write it as CQUAD4 or CTRIA3");
    } else if (!systems_.add(card)) {
      ++left_[card.name];
    }
  }

  void grid(const BulkCard& card) {
    CardFields fields(card, diagnostics_);
    const auto id = fields.integer(1, "its number");
    const auto system = fields.integer(2, "CP", default_system_);
    const auto place = systems_.to_basic(system, fields.point(3, "a coordinate"), fields, diagnostics_);
    if (fields.set(7)) ++left_["PS (constraint) of GRID"];
    if (!places_.emplace(id, std::pair(place, fields.location())).second)
      fields.fault("this number is taken; give each GRID its own");
  }

  void element(CardFields& fields, std::size_t corners) {
    Element element{.id = fields.integer(1, "its number"), .property = 0, .nodes = {}, .location = fields.location()};
    element.property = fields.integer(2, "PID", element.id);
    for (std::size_t i = 0; i < corners; ++i) element.nodes.push_back(fields.integer(3 + i, "a node"));
    if (std::set(element.nodes.begin(), element.nodes.end()).size() < corners)
      fields.fault("a node is named twice; write a CTRIA3 of three nodes");
    const std::size_t offset = corners + 4, first_thickness = 11;
    if (fields.set(offset)) fields.fault("its offset ZOFFS is not read; move its nodes into the middle surface");
    for (std::size_t i = 0; i < corners; ++i)
      if (fields.set(first_thickness + i))
        return fields.fault("thicknesses at its nodes are not read; give the property one thickness");
    elements_.push_back(std::move(element));
  }

  void property(CardFields& fields) {
    const auto id = fields.integer(1, "its number");
    Property property{
        .name = {}, .material = fields.integer(2, "MID1"), .thickness = fields.real(3, "T"), .location = fields.location()};
    if (property.thickness <= 0.0) fields.fault(fmt::format("its thickness is {}; give one > 0", property.thickness));
    if (fields.integer(4, "MID2", 0) != property.material || fields.real(5, "12I/T**3", 1.0) != 1.0)
      fields.fault("it bends otherwise than a homogeneous plate; give MID2 = MID1 and leave 12I/T**3 blank");
    if (fields.integer(6, "MID3", property.material) != property.material || !fields.blank(11))
      fields.fault("MID3 and MID4 other than MID1 are not read; give MID3 = MID1 and leave MID4 blank");
    if (fields.set(8)) fields.fault("its mass NSM is not read; leave it blank and make the material denser");
    property.name = name_of("PROP", "PSHELL", id);
    if (!properties_.emplace(id, property).second) fields.fault("this number is taken; give each PSHELL its own");
  }

  void material(CardFields& fields) {
    const auto id = fields.integer(1, "its number");
    if (!material_rows_.emplace(id, static_cast<std::int32_t>(model_.materials.size())).second)
      fields.fault("this number is taken; give each MAT1 its own");
    double young = fields.real(2, "E", 0.0), shear = fields.real(3, "G", 0.0), poisson = fields.real(4, "NU", 0.0);
    const bool has_young = !fields.blank(2), has_shear = !fields.blank(3), has_poisson = !fields.blank(4);
    if (has_young + has_shear + has_poisson < 2) return fields.fault("it needs two of E, G and NU; give them");
    if (!has_young) young = 2.0 * shear * (1.0 + poisson);
    if (!has_poisson) poisson = 0.5 * young / shear - 1.0;
    if (has_young && has_shear && has_poisson && std::abs(shear * 2.0 * (1.0 + poisson) - young) > 0.01 * young)
      fields.fault("E, G and NU are not those of an isotropic material; leave one of them blank");
    if (young <= 0.0 || poisson <= -1.0 || poisson >= 0.5)
      fields.fault(fmt::format("E = {} and NU = {} are no elastic material; give E > 0 and -1 < NU < 0.5", young, poisson));
    if (fields.set(6)) ++left_["A (thermal expansion) of MAT1"];
    if (fields.set(8)) ++left_["GE (damping) of MAT1"];
    model_.materials.push_back({.name = name_of("MAT", "MAT1", id),
                                .density = fields.real(5, "RHO", 0.0),
                                .law = "elastic",
                                .parameters = {young, poisson},
                                .location = fields.location()});
  }

  /// As the preprocessor calls it, where no other has that name.
  std::string name_of(const std::string& kind, const std::string& card, std::int64_t id) {
    const auto found = data_.names.find({kind, id});
    if (found != data_.names.end() && !found->second.empty() && names_.insert(kind + found->second).second) return found->second;
    return fmt::format("{}-{}", card, id);
  }

  void check_elements() {
    std::set<std::int64_t> ids;
    for (const auto& [id, property, nodes, location] : elements_) {
      const auto fault = [&, id = id, location = location](const std::string& text) {
        diagnostics_.error(location, "", fmt::format("element {}: {}", id, text));
      };
      if (!ids.insert(id).second) fault("this number is taken; give each element its own");
      if (!properties_.contains(property)) fault(fmt::format("no PSHELL {} describes it; add one, or name another", property));
      for (const auto node : nodes)
        if (!places_.contains(node)) fault(fmt::format("no GRID {} is there; add it, or name another", node));
    }
    for (const auto& [id, property] : properties_)
      if (!material_rows_.contains(property.material))
        diagnostics_.error(property.location, "",
                           fmt::format("PSHELL {}: no MAT1 {} describes it; add one, or name another", id, property.material));
  }

  void build() {
    std::vector<std::vector<std::int64_t>*> shells;
    for (auto& element : elements_) shells.push_back(&element.nodes);
    turned_ = unify_sides(shells);
    std::set<std::int64_t> used;
    for (const auto& element : elements_) used.insert(element.nodes.begin(), element.nodes.end());
    for (const auto id : used) {
      model_.nodes.row_of_id.emplace(id, model_.nodes.size());
      model_.nodes.id.push_back(id);
      model_.nodes.coordinates.push_back(places_.at(id).first);
      model_.nodes.location.push_back(places_.at(id).second);
    }
    if (const auto unused = static_cast<int>(places_.size() - used.size()); unused > 0) left_["GRID that no element uses"] = unused;
    for (const auto& [id, property] : properties_) add_section(id, property);
  }

  void add_section(std::int64_t id, const Property& property) {
    const auto row = static_cast<std::int32_t>(model_.sections.size());
    ElementSet set{.name = property.name, .elements = {}};
    for (const auto& element : elements_)
      if (element.property == id) set.elements.push_back(add_element(element, row));
    if (set.elements.empty()) return;
    std::ranges::sort(set.elements);
    model_.element_sets.push_back(std::move(set));
    model_.sections.push_back({.kind = Section::Kind::shell,
                               .element_set = property.name,
                               .material = material_rows_.at(property.material),
                               .thickness = property.thickness,
                               .location = property.location});
  }

  ElementRef add_element(const Element& element, std::int32_t section) {
    const auto* type = find_element_type(element.nodes.size() == 4 ? "S4R" : "S3R");
    auto table = std::ranges::find(model_.elements, type, &ElementTable::type);
    if (table == model_.elements.end()) table = model_.elements.insert(table, {.type = type});
    for (const auto node : element.nodes) table->connectivity.push_back(model_.nodes.row_of_id.at(node));
    table->id.push_back(element.id);
    table->section.push_back(section);
    table->location.push_back(element.location);
    return {static_cast<std::int32_t>(table - model_.elements.begin()), table->size() - 1};
  }

  std::string summary() const {
    auto text = fmt::format("{} nodes", model_.nodes.size());
    for (const auto& table : model_.elements) text += fmt::format(", {} {}", table.size(), table.type->name);
    text += "; numbers stay in the file's units\n";
    for (const auto& section : model_.sections)
      text += fmt::format("  {}: thickness {}, material {}\n", section.element_set, section.thickness,
                          model_.materials[section.material].name);
    if (turned_ > 0) text += fmt::format("note: {} shells turned round, so that surfaces have one side each\n", turned_);
    std::vector<std::string> words;
    for (const auto& [what, count] : left_) words.push_back(fmt::format("{} {}", count, what));
    return words.empty() ? text : text + fmt::format("note: not taken over: {}\n", deck::join(words));
  }

  deck::Diagnostics diagnostics_;
  BulkData data_;
  Model model_;
  CoordinateSystems systems_;
  std::int64_t default_system_ = 0;  // of GRDSET
  std::vector<const BulkCard*> grids_;
  std::map<std::int64_t, std::pair<Point, Location>> places_;
  std::map<std::int64_t, Property> properties_;
  std::map<std::int64_t, std::int32_t> material_rows_;
  std::vector<Element> elements_;
  std::set<std::string> names_;
  std::map<std::string, int> left_;  // what is not taken over
  int turned_ = 0;                   // shells that pointed to the other side
};

}  // namespace

}  // namespace balocco::nastran

namespace balocco {

NastranMesh read_nastran(const std::string& text, const std::string& file_name) {
  return nastran::Reader(text, file_name).read();
}

}  // namespace balocco
