#include "xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "elements/element_type.hpp"
#include "model/diagnostics.hpp"

namespace balocco {

namespace {

/// XDMF's name of a shape, or nullptr where there is nothing to draw.
const char* topology_of(const std::string& type) {
  const ElementType* element = find_element_type(type);
  switch (element == nullptr ? Shape::point : element->shape) {
    case Shape::line: return "Polyline";
    case Shape::triangle: return "Triangle";
    case Shape::quadrilateral: return "Quadrilateral";
    case Shape::wedge: return "Wedge";
    case Shape::hexahedron: return "Hexahedron";
    case Shape::tetrahedron: return "Tetrahedron";
    case Shape::quadratic_tetrahedron: return "Tetrahedron_10";
    case Shape::quadratic_wedge: return "Wedge_15";
    case Shape::quadratic_hexahedron: return "Hexahedron_20";
    case Shape::point: break;
  }
  return nullptr;
}

class XdmfWriter {
 public:
  XdmfWriter(const ResultsIndex& index, const std::string& results_name) : index_(index), name_(results_name) {}

  std::string text(const std::vector<FrameRecord>& frames) {
    line("<?xml version=\"1.0\" ?>");
    line("<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>");
    line("<Xdmf Version=\"3.0\"><Domain>");
    line("<Grid Name=\"results\" GridType=\"Collection\" CollectionType=\"Temporal\">");
    const FrameRecord* last = nullptr;
    for (const FrameRecord& frame : frames) {
      // The first frame of a step repeats the end of the step before: readers want times that increase.
      if (last != nullptr && frame.time <= last->time) continue;
      write_frame(frame);
      last = &frame;
    }
    line("</Grid>");
    line("</Domain></Xdmf>");
    return std::move(text_);
  }

 private:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  void write_frame(const FrameRecord& frame) {
    line("<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Spatial\">", frame.path.substr(1));
    line("<Time Value=\"{:.17g}\"/>", frame.time);
    for (const MeshBlock& block : index_.blocks) {
      const char* topology = topology_of(block.type);
      if (topology != nullptr && block.elements > 0) write_block(frame, block, topology);
    }
    line("</Grid>");
  }

  void write_block(const FrameRecord& frame, const MeshBlock& block, const char* topology) {
    const std::string mesh = "/mesh/element/" + block.type;
    line("<Grid Name=\"{}\">", block.type);
    line("<Topology TopologyType=\"{}\" NumberOfElements=\"{}\" NodesPerElement=\"{}\">", topology, block.elements,
         block.nodes_per_element);
    line("<DataItem Dimensions=\"{} {}\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">{}:{}/connectivity</DataItem>",
         block.elements, block.nodes_per_element, name_, mesh);
    line("</Topology>");
    line("<Geometry GeometryType=\"XYZ\">");
    line("<DataItem Dimensions=\"{} 3\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">{}:/mesh/node/coordinates</DataItem>",
         index_.nodes, name_);
    line("</Geometry>");
    line("<Attribute Name=\"part\" AttributeType=\"Scalar\" Center=\"Cell\">");
    line("<DataItem Dimensions=\"{}\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">{}:{}/part</DataItem>", block.elements,
         name_, mesh);
    line("</Attribute>");
    for (const FieldRecord& field : frame.nodes.fields) write_attribute(field, "Node", frame.path + "/node/");
    const auto values = std::find_if(frame.elements.begin(), frame.elements.end(),
                                     [&](const FieldBlock& candidate) { return candidate.type == block.type; });
    if (values != frame.elements.end()) {
      for (const FieldRecord& field : values->fields) {
        write_attribute(field, "Cell", frame.path + "/element/" + block.type + "/");
      }
    }
    line("</Grid>");
  }

  /// Six components go as a matrix: XDMF's Tensor6 means another order (11 12 13 22 23 33) than ours.
  void write_attribute(const FieldRecord& field, const char* center, const std::string& group) {
    if (field.extent.size() > 2) return;  // values at integration points are for scripts
    const hsize_t columns = field.extent.size() == 2 ? field.extent[1] : 1;
    const char* kind = columns == 1 ? "Scalar" : columns == 3 ? "Vector" : "Matrix";
    const std::string size = columns == 1 ? fmt::format("{}", field.extent[0]) : fmt::format("{} {}", field.extent[0], columns);
    line("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">", field.name, kind, center);
    line("<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"{}\" Format=\"HDF\">{}:{}{}</DataItem>", size,
         field.bytes, name_, group, field.name);
    line("</Attribute>");
  }

  const ResultsIndex& index_;
  const std::string& name_;
  std::string text_;
};

}  // namespace

std::string xdmf_text(const ResultsIndex& index, const std::string& results_name) {
  auto frames = index.frames;
  std::erase_if(frames, [](const FrameRecord& frame) { return frame.frequency.has_value(); });
  return XdmfWriter(index, results_name).text(frames);
}

std::string harmonic_xdmf_text(const ResultsIndex& index, std::int32_t step, const std::string& results_name) {
  auto frames = index.frames;
  const std::string prefix = step_path(step) + "/";
  std::erase_if(frames, [&](const FrameRecord& frame) { return !frame.frequency || !frame.path.starts_with(prefix); });
  for (auto& frame : frames) frame.time = *frame.frequency;
  return XdmfWriter(index, results_name).text(frames);
}

std::string modes_xdmf_text(const ResultsIndex& index, const std::string& results_name) {
  return XdmfWriter(index, results_name).text(index.modes);
}

void replace_file(const std::string& path, const std::string& text) {
  const std::string beside = path + ".tmp";
  std::FILE* file = std::fopen(beside.c_str(), "w");
  const bool written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = file != nullptr && std::fclose(file) == 0;
  if (!written || !closed || std::rename(beside.c_str(), path.c_str()) != 0) {
    throw SystemError(fmt::format("{}: cannot be written", path));
  }
}

}  // namespace balocco
