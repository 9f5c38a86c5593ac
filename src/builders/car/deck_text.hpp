// Text of a deck as an engineer would write it: keywords, data lines, comments.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "builders/car/curve.hpp"

namespace balocco::car {

class DeckText {
 public:
  /// A chapter: a comment line that is seen from far.
  void chapter(const std::string& title) {
    text_ += fmt::format("**\n** ---- {} {}\n", title, std::string(title.size() < 110 ? 110 - title.size() : 0, '-'));
  }
  void comment(const std::string& words) { text_ += "** " + words + "\n"; }
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }
  /// Numbers, 12 a line.
  void numbers(const std::vector<std::int64_t>& all);
  /// A node, with its coordinates to the millionth of a millimetre.
  void node(std::int64_t id, const Vector& place) {
    line("{}, {:.6f}, {:.6f}, {:.6f}", id, place[0] + 0.0, place[1] + 0.0, place[2] + 0.0);
  }

  /// A node that is a set of its own, by whose name others find it.
  std::int64_t named_node(const std::string& name, const Vector& place);
  /// @throws InputError where no node has that name: a mount is missing.
  std::int64_t node_of(const std::string& name) const;

  /// Where the named node lies. @throws InputError as node_of.
  const Vector& place_of(const std::string& name) const;

  /// Gives the next ids away; who asked for them writes the nodes.
  void reserve_nodes(std::int64_t count) { nodes_ += count; }
  std::int64_t next_node() { return ++nodes_; }
  std::int64_t last_node() const { return nodes_; }
  std::int64_t next_element() { return ++elements_; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  struct Named {
    std::int64_t id = 0;
    Vector place;
  };
  const Named& find(const std::string& name) const;
  std::map<std::string, Named> named_;
  std::int64_t nodes_ = 0, elements_ = 0;  // the last ids given away
};

}  // namespace balocco::car
