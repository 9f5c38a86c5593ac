#include "builders/car/body_deck.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "builders/car/rail_sections.hpp"
#include "model/diagnostics.hpp"

namespace balocco::car {
namespace {

std::string upper(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

const GaugeSpec& gauge_of(const CarSpec& spec, const Part& part) {
  const auto found = spec.gauges.find(part.gauge);
  if (found == spec.gauges.end())
    throw InputError(
        fmt::format("{}: error: [gauge] {}: this part has no gauge; add it to the parts of one", spec.gauges_where, part.gauge));
  return found->second;
}

void write_welds(const CarSpec& spec, const BodyMesh& mesh, bool body, DeckText& deck) {
  deck.comment("spot welds: the first node carries the others; each weld is a small system of its own");
  deck.line("*MPC");
  for (auto weld : mesh.welds()) {
    if ((mesh.part_of(weld[0]).assembly == "BODY") != body) continue;
    // A rigid node carries the others, so that nothing joins two of them by way of one that is not.
    std::stable_partition(weld.begin(), weld.end(), [&](int node) { return is_rigid(spec, mesh.part_of(node)); });
    for (std::size_t i = 1; i < weld.size(); ++i) deck.line("BEAM, {}, {}", weld[i] + 1, weld[0] + 1);
  }
}

/// The parts of the body, or those of the other assemblies, with what they are pressed from and their welds.
void write_parts(const CarSpec& spec, const BodyMesh& mesh, bool body, DeckText& deck) {
  std::map<std::string, std::vector<const Part*>> assemblies;
  for (const auto& part : mesh.parts())
    if ((part.assembly == "BODY") == body) assemblies[part.assembly].push_back(&part);
  for (const auto& [assembly, parts] : assemblies) {
    for (const auto* part : parts) {
      deck.line("*NODE, NSET=N_{}", part->name);
      for (int node = part->first_node; node < part->first_node + part->nodes; ++node) deck.node(node + 1, mesh.nodes()[node]);
      deck.line("*ELEMENT, TYPE=S4R, ELSET={}", part->name);
      std::int64_t last = 0;
      for (const auto& q : part->quadrilaterals)
        deck.line("{}, {}, {}, {}, {}", last = deck.next_element(), q[0] + 1, q[1] + 1, q[2] + 1, q[3] + 1);
      write_rail_section(mesh, *part, last + 1 - static_cast<std::int64_t>(part->quadrilaterals.size()), deck);
      const auto& gauge = gauge_of(spec, *part);
      deck.line("*SHELL SECTION, ELSET={}, MATERIAL={}\n{:g}, 5", part->name, upper(gauge.material), gauge.thickness);
    }
    deck.line("*ELSET, ELSET={}", assembly);
    for (const auto* part : parts) deck.line("{}", part->name);
  }
  write_welds(spec, mesh, body, deck);
}

void write_mount(const CarSpec& spec, const BodyMesh& mesh, const MountSpec& mount, std::set<int>& taken, DeckText& deck) {
  auto carriers = mesh.free_nodes(mount.parts, mount.place, mount.reach);
  std::erase_if(carriers, [&](int node) { return taken.contains(node); });
  if (carriers.size() < 3)
    throw InputError(
        fmt::format("{}: error: [{}.{}] reach: {} free nodes of its parts lie within {:g} mm of it, and three are needed; reach "
                    "farther, or name more parts",
                    mount.where, mount.mass > 0.0 ? "mass" : "mount", mount.name, carriers.size(), mount.reach));
  taken.insert(carriers.begin(), carriers.end());
  const auto name = upper(mount.name);
  const auto node = deck.named_node(name, mount.place);
  if (mount.mass > 0.0) write_mass(name, node, mount.mass, mount.size, deck);
  write_coupling(name, node, carriers, deck);
}

}  // namespace

void Inertia::add(double mass, const Vector& place) {
  mass_ += mass;
  moment_ = moment_ + mass * place;
  for (int c = 0; c < 3; ++c) squares_[c] += mass * place[c] * place[c];
}

void Inertia::add_box(double mass, const Vector& place, const std::array<double, 3>& size) {
  add(mass, place);
  for (int c = 0; c < 3; ++c) squares_[c] += mass * size[c] * size[c] / 12.0;
}

std::array<double, 3> Inertia::about_centre() const {
  return about(centre());
}

std::array<double, 3> Inertia::about(const Vector& place) const {
  std::array<double, 3> squares{};
  for (int c = 0; c < 3; ++c) squares[c] = squares_[c] - mass_ * place[c] * place[c];
  return {squares[1] + squares[2], squares[2] + squares[0], squares[0] + squares[1]};
}

std::array<double, 3> box_inertia(double mass, const std::array<double, 3>& size) {
  const auto square = [&](int c) { return mass * size[c] * size[c] / 12.0; };
  return {square(1) + square(2), square(2) + square(0), square(0) + square(1)};
}

void add_part(const CarSpec& spec, const BodyMesh& mesh, const Part& part, Inertia& inertia) {
  const auto& gauge = gauge_of(spec, part);
  const auto material = std::ranges::find(spec.materials, gauge.material, &SheetMaterial::name);
  for (const auto& corners : part.quadrilaterals) {
    const auto &a = mesh.nodes()[corners[0]], &b = mesh.nodes()[corners[1]], &c = mesh.nodes()[corners[2]],
               &d = mesh.nodes()[corners[3]];
    inertia.add(0.5 * length(cross(c - a, d - b)) * gauge.thickness * material->density, 0.25 * (a + b + c + d));
  }
}

bool is_rigid(const CarSpec& spec, const Part& part) {
  if (part.assembly == "REAR_AXLE") return false;
  if (spec.fidelity == "semi-flexible") return part.assembly == "BODY" && !part.gauge.starts_with("STRUT_HOUSE");
  return spec.fidelity == "rigid";
}

void write_body(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck) {
  deck.reserve_nodes(static_cast<std::int64_t>(mesh.nodes().size()));
  deck.chapter("CHASSIS: pressings of the subframe and the rear axle");
  write_parts(spec, mesh, false, deck);
  deck.chapter("BODY IN WHITE: every pressing is a part");
  write_parts(spec, mesh, true, deck);
}

std::vector<MountSpec> on_both_sides(const std::vector<MountSpec>& mounts) {
  std::vector<MountSpec> all;
  for (const auto& mount : mounts) {
    all.push_back(mount);
    if (!mount.both_sides) continue;
    all.back().name += "_left";
    all.push_back(mount);
    all.back().name += "_right";
    all.back().place = mirrored(mount.place);
  }
  return all;
}

void write_mounts(const CarSpec& spec, const BodyMesh& mesh, DeckText& deck) {
  std::set<int> taken;  // a node carries one of them, so that their systems stay apart
  deck.chapter("MOUNTS: where the suspension and the engine push");
  for (const auto& mount : on_both_sides(spec.mounts)) write_mount(spec, mesh, mount, taken, deck);
  deck.chapter("MASSES: hung on free nodes of the parts around them");
  for (const auto& mass : on_both_sides(spec.masses)) write_mount(spec, mesh, mass, taken, deck);
}

void write_mass(const std::string& name, std::int64_t node, double mass, const std::array<double, 3>& size, DeckText& deck) {
  deck.line("*ELEMENT, TYPE=MASS, ELSET=M_{}\n{}, {}\n*MASS, ELSET=M_{}\n{:g}", name, deck.next_element(), node, name, mass);
  const auto own = box_inertia(mass, size);
  deck.line("*ELEMENT, TYPE=ROTARYI, ELSET=I_{}\n{}, {}\n*ROTARY INERTIA, ELSET=I_{}\n{:.6g}, {:.6g}, {:.6g}", name,
            deck.next_element(), node, name, own[0], own[1], own[2]);
}

void write_coupling(const std::string& name, std::int64_t node, const std::vector<int>& carriers, DeckText& deck) {
  std::vector<std::int64_t> ids;
  for (const int carrier : carriers) ids.push_back(carrier + 1);
  deck.line("*NSET, NSET=C_{}", name);
  deck.numbers(ids);
  deck.line("*SURFACE, TYPE=NODE, NAME=C_{}\nC_{}", name, name);
  deck.line("*COUPLING, CONSTRAINT NAME={}, REF NODE={}, SURFACE=C_{}\n*DISTRIBUTING", name, node, name);
}

void write_materials(const CarSpec& spec, DeckText& deck) {
  deck.chapter("MATERIALS");
  for (const auto& material : spec.materials) {
    deck.line("*MATERIAL, NAME={}\n*DENSITY\n{:g}\n*ELASTIC\n{:g}, {:g}", upper(material.name), material.density, material.modulus,
              material.poisson);
    if (material.plastic.empty()) continue;
    deck.line("*PLASTIC");
    for (const auto& [stress, strain] : material.plastic) deck.line("{:g}, {:g}", stress, strain);
    if (material.rate_reference > 0.0)
      deck.line("*RATE DEPENDENT, TYPE=POWER LAW\n{:g}, {:g}", material.rate_reference, material.rate_exponent);
  }
}

}  // namespace balocco::car
