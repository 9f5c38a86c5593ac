// balocco_bench: nanoseconds, floating-point operations and bytes per element-cycle of every explicit element type and
// law on a block of about 100 000 elements, against what the core can do. Usage: balocco_bench
// [--benchmark_filter=C3D8R]
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "elements/aligned_vector.hpp"
#include "elements/element_type.hpp"
#include "flops.hpp"
#include "machine.hpp"
#include "math/exact_sum.hpp"
#include "model/model.hpp"

namespace balocco::bench {

namespace {

struct Subject {
  std::string type, law;
  std::vector<double> parameters;
  std::vector<MaterialOption> options = {};
  double disorder = 0.01;  // of the nodes; strains are about ten times that
};

/// Nodes of a grid of cells and the connectivity of one element type in it.
struct Mesh {
  std::vector<Point> points;
  std::vector<std::int32_t> connectivity;
};

/// How a cell's corners (bit 0: x, bit 1: y, bit 2: z) make elements.
std::vector<std::vector<int>> elements_of_cell(const std::string& type) {
  if (type == "C3D8R" || type == "C3D8") return {{0, 1, 3, 2, 4, 5, 7, 6}};
  if (type == "C3D6") return {{0, 1, 3, 4, 5, 7}, {0, 3, 2, 4, 7, 6}};
  if (type == "M3D4" || type == "M3D4R" || type == "S4" || type == "S4R") return {{0, 1, 3, 2}};
  if (type == "M3D3" || type == "S3R") return {{0, 1, 3}, {0, 3, 2}};
  return {{0, 1}};
}

Mesh make_mesh(const std::string& type) {
  const auto cell = elements_of_cell(type);
  const bool solid = cell[0].size() > 4;
  const bool halves = cell.size() == 2;
  const std::array<int, 3> cells =
      solid ? std::array<int, 3>{46, 46, halves ? 23 : 46} : std::array<int, 3>{halves ? 224 : 316, 316, 0};
  Mesh mesh;
  const auto node = [&](int i, int j, int k) { return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i; };
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) mesh.points.push_back({1.0 * i, 1.0 * j, 1.0 * k});
  for (int k = 0; k < std::max(cells[2], 1); ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        for (const auto& corners : cell)
          for (const int c : corners)
            mesh.connectivity.push_back(node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)));
  return mesh;
}

Model make_model(const Subject& subject, const Mesh& mesh) {
  Model model;
  model.nodes.coordinates = mesh.points;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) model.nodes.id.push_back(static_cast<std::int64_t>(i) + 1);
  ElementTable table;
  table.type = find_element_type(subject.type);
  table.connectivity = mesh.connectivity;
  const std::size_t count = mesh.connectivity.size() / table.type->nodes;
  for (std::size_t i = 0; i < count; ++i) table.id.push_back(static_cast<std::int64_t>(i) + 1);
  table.section.assign(count, 0);
  table.location.resize(count);
  model.elements.push_back(std::move(table));
  Material material;
  material.density = 1.0;
  material.law = subject.law;
  material.parameters = subject.parameters;
  material.options = subject.options;
  model.materials.push_back(material);
  Section section;
  section.kind = model.elements[0].type->section;
  section.material = 0;
  section.thickness = 0.1;
  section.beam.shape = BeamProfile::Shape::rectangle;
  section.beam.dimensions = {0.2, 0.1};
  model.sections.push_back(section);
  return model;
}

/// Traffic an element cannot avoid: its record and history, its connectivity, and its share of the nodes (position
/// read, force read and written).
double bytes_per_cycle(const ElementGroup& group, std::size_t nodes) {
  const double share = static_cast<double>(nodes) / group.size();
  return static_cast<double>(group.bytes_per_element()) + 8.0 * group.history_size() + share * 96.0;
}

void cycle_elements(benchmark::State& state, const Subject& subject) {
  const Mesh mesh = make_mesh(subject.type);
  const Model model = make_model(subject, mesh);
  const auto count = static_cast<std::int32_t>(model.elements[0].size());
  GroupInput input{model, 0, 0, {}, 0, mesh.connectivity, static_cast<std::int32_t>(mesh.points.size())};
  for (std::int32_t row = 0; row < count; ++row) input.rows.push_back(row);
  const auto group = model.elements[0].type->make_group(input);

  AlignedVector<double> position(4 * mesh.points.size() + 4, 0.0), velocity(position), force(position), orientation(position);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (int d = 0; d < 3; ++d)
      position[4 * i + d] = mesh.points[i][d] * (1.0 + subject.disorder * d) + subject.disorder * static_cast<double>((i * (7 + d)) % 11);
    force[4 * i + 3] = rounding_constant(1e3);
    orientation[4 * i] = 1.0;
  }
  AlignedVector<double> moment(force);
  std::vector<double> history = group->initial_history();
  const ExplicitCycle cycle{{position.data(), velocity.data(), orientation.data(), velocity.data()},
                            {force.data(), moment.data()},
                            1e-3,
                            0.06,
                            1.2};
  for (auto _ : state) benchmark::DoNotOptimize(group->add_forces(Portion::interior, cycle, history));

  const double cycles = static_cast<double>(state.iterations()) * count;
  const double flops = flops_per_element(subject.type, subject.law),
               bytes = bytes_per_cycle(*group, mesh.points.size());
  state.counters["ns/element"] =
      benchmark::Counter(1e-9 * cycles, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["bytes"] = bytes;
  state.counters["GB/s"] = benchmark::Counter(1e-9 * bytes * cycles, benchmark::Counter::kIsRate);
  if (flops > 0.0) {
    state.counters["flops"] = flops;
    state.counters["Gflop/s"] = benchmark::Counter(1e-9 * flops * cycles, benchmark::Counter::kIsRate);
  }
}

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const std::string type : {"C3D8R", "C3D8", "C3D6"}) {
    all.push_back({type, "elastic", {1000.0, 0.3}});
    all.push_back({type, "neo-hooke", {0.5, 0.05}});
    all.push_back({type, "mooney-rivlin", {0.4, 0.1, 0.05}});
  }
  const MaterialOption hardening{"plastic", {0.0}, {{1.0, 0.0}, {10.0, 1.0}}};
  all.push_back({"C3D8R", "elastic", {1000.0, 0.3}, {hardening}, 0.001});  // metals do not change their volume by more
  all.push_back({"C3D8R", "orthotropic", {120.0, 30.0, 100.0, 25.0, 20.0, 90.0, 30.0, 35.0, 40.0}});
  for (const std::string type : {"M3D4R", "M3D4", "M3D3"}) {
    all.push_back({type, "elastic", {1000.0, 0.3}});
    all.push_back({type, "lamina", {1000.0, 100.0, 0.3, 50.0, 50.0, 50.0}});
    all.push_back({type, "neo-hooke", {0.5, 0.05}});
  }
  for (const std::string type : {"S4R", "S4", "S3R"}) {
    all.push_back({type, "elastic", {1000.0, 0.3}});
    all.push_back({type, "elastic", {1000.0, 0.3}, {hardening}});
  }
  all.push_back({"T3D2", "elastic", {1000.0, 0.3}});
  all.push_back({"B31", "elastic", {1000.0, 0.3}});
  return all;
}

}  // namespace

}  // namespace balocco::bench

int main(int argc, char** argv) {
  using namespace balocco;
  for (const auto& subject : bench::subjects())
    if (find_element_type(subject.type) != nullptr)
      benchmark::RegisterBenchmark((subject.type + "/" + (subject.options.empty() ? subject.law : subject.options[0].name)).c_str(), [subject](benchmark::State& state) {
        bench::cycle_elements(state, subject);
      })->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::printf("this core: %.1f Gflop/s (fused multiply-add; half of it without), %.1f GB/s (triad)\n",
              bench::peak_flops_per_ns(), bench::triad_bytes_per_ns());
  std::fflush(stdout);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
