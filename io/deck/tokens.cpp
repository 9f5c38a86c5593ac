#include "deck/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "deck/expression.hpp"
#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// Lines of one text, without line ends of either kind.
class LineCursor {
 public:
  explicit LineCursor(std::string_view text) : rest_(text) {}

  /// Goes to the next line, if there is one.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const auto end = rest_.find('\n');
    line = trim(rest_.substr(0, end));
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++number_;
    return true;
  }

  std::int32_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::int32_t number_ = 0;
};

/// Zero bytes anywhere, or control characters at the beginning that no text has.
bool is_binary(const std::string& text) {
  const auto control = [](char c) {
    return c >= 0 && c < 32 && c != '\n' && c != '\r' && c != '\t' && c != '\f' && c != '\v';
  };
  const auto beginning = std::string_view(text).substr(0, 4096);
  return text.find('\0') != std::string::npos || std::any_of(beginning.begin(), beginning.end(), control);
}

/// The byte order mark that some editors put before UTF-8 text.
std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

bool is_utf16(std::string_view text) {
  return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
}

bool is_comment(std::string_view line) {
  return line.starts_with("**");
}

/// True if a line can go on with a keyword whose line ended with a comma: no parameter begins like a number.
bool may_continue(std::string_view line) {
  const auto first = trim(line.substr(0, line.find(',')));
  return !line.empty() && line.front() != '*' && !first.empty() && !parse_real(first);
}

/// A keyword with the lines that it runs over.
struct KeywordText {
  std::string_view text;
  std::int32_t line = 0;
};

class Tokenizer {
 public:
  Tokenizer(const FileLoader& loader, Diagnostics& diagnostics) : loader_(loader), diagnostics_(diagnostics) {}

  void read(const std::string& path, Location included_from, std::string_view keyword);
  Tokens take() { return std::move(tokens_); }

 private:
  void read_lines(std::int32_t file, std::string_view text);
  void keyword_lines(const std::vector<KeywordText>& lines, std::int32_t file);
  void data_line(std::string_view line, Location location);
  void parameter_line(std::string_view line, Location location);
  std::string_view substitute(std::string_view line, Location location);
  void open_block(const std::vector<KeywordText>& lines, std::int32_t file);
  static void add_parameter(Block& block, std::string_view field, std::int32_t line);

  const FileLoader& loader_;
  Diagnostics& diagnostics_;
  Tokens tokens_;
  std::vector<std::string> chain_;  // files being read, outermost first
  ParameterValues parameters_;
  bool inside_parameter_ = false, told_stray_data_ = false;
};

void Tokenizer::read(const std::string& path, Location included_from, std::string_view keyword) {
  const std::string normal = std::filesystem::path(path).lexically_normal().string();
  if (std::find(chain_.begin(), chain_.end(), normal) != chain_.end()) {
    std::string loop;
    for (const auto& file : chain_) loop += file + " -> ";
    diagnostics_.error(included_from, keyword,
                       fmt::format("file {} includes itself ({}); break the loop", path, loop + normal));
    return;
  }
  auto text = loader_(path);
  if (!text) {
    if (included_from.file < 0) tokens_.files.push_back(path);
    diagnostics_.error(included_from, keyword,
                       fmt::format("cannot read file {}; check its name and folder (names count from "
                                   "the folder of the file that asks for it)",
                                   path));
    return;
  }
  if (text->find('\n') == std::string::npos) std::ranges::replace(*text, '\r', '\n');  // line ends of old Macintoshes
  tokens_.texts.push_back(std::move(*text));
  const std::string& stored = tokens_.texts.back();
  const auto file = static_cast<std::int32_t>(tokens_.files.size());
  tokens_.files.push_back(path);
  if (is_binary(stored)) {
    diagnostics_.error({file, 1}, "",
                       is_utf16(stored) ? "the text is UTF-16; save it as plain text or UTF-8"
                                        : "this is not a text file; give a deck in Abaqus keyword syntax");
    return;
  }
  chain_.push_back(normal);
  read_lines(file, without_mark(stored));
  chain_.pop_back();
}

void Tokenizer::read_lines(std::int32_t file, std::string_view text) {
  LineCursor cursor(text);
  std::string_view line;
  while (cursor.next(line)) {
    if (line.empty() || is_comment(line)) continue;
    const Location location{file, cursor.number()};
    if (line.front() != '*') {
      data_line(line, location);
      continue;
    }
    std::vector<KeywordText> keyword{{line, location.line}};
    for (LineCursor ahead = cursor; keyword.back().text.back() == ',' && ahead.next(line);) {
      if (is_comment(line)) continue;
      if (!may_continue(line)) break;
      keyword.push_back({line, ahead.number()});
      cursor = ahead;
    }
    keyword_lines(keyword, file);
  }
}

void Tokenizer::keyword_lines(const std::vector<KeywordText>& lines, std::int32_t file) {
  const Location location{file, lines.front().line};
  inside_parameter_ = lines.size() == 1 && squeeze(lines.front().text) == "*PARAMETER";
  if (inside_parameter_) return;
  open_block(lines, file);
  const Block& block = tokens_.blocks.back();
  const bool include = block.keyword == "INCLUDE";
  if (const Parameter* input = block.find("INPUT"); input != nullptr && input->has_value) {
    std::string name = input->raw;
    std::ranges::replace(name, '\\', '/');  // decks come from Windows, too
    const auto folder = std::filesystem::path(tokens_.files[location.file]).parent_path();
    const std::string path = std::filesystem::path(name).is_absolute() ? name : (folder / name).string();
    if (include) tokens_.blocks.pop_back();
    read(path, location, include ? "INCLUDE" : std::string(block.written));
  } else if (include) {
    diagnostics_.error(location, "INCLUDE", "the file is not named; write *INCLUDE, INPUT=FILE");
    tokens_.blocks.pop_back();
  }
}

void Tokenizer::open_block(const std::vector<KeywordText>& lines, std::int32_t file) {
  Block block;
  block.location = {file, lines.front().line};
  std::vector<std::string_view> fields;
  for (const auto& [text, line] : lines) {
    split(substitute(text, {file, line}), fields);
    std::size_t first = 0;
    if (&text == &lines.front().text) {
      const auto keyword = fields.front().substr(1);
      block.keyword = squeeze(keyword);
      block.written = upper(trim(keyword));
      first = 1;
    }
    for (std::size_t i = first; i < fields.size(); ++i) add_parameter(block, fields[i], line);
  }
  tokens_.blocks.push_back(std::move(block));
}

void Tokenizer::add_parameter(Block& block, std::string_view field, std::int32_t line) {
  if (field.empty()) return;
  Parameter parameter;
  const auto equals = field.find('=');
  parameter.written = trim(field.substr(0, equals));
  parameter.name = squeeze(parameter.written);
  parameter.line = line;
  if (equals != std::string_view::npos) {
    parameter.has_value = true;
    parameter.raw = trim(field.substr(equals + 1));
    std::erase(parameter.raw, '"');
    parameter.value = upper(parameter.raw);
  }
  block.parameters.push_back(std::move(parameter));
}

void Tokenizer::data_line(std::string_view line, Location location) {
  if (inside_parameter_) {
    parameter_line(line, location);
  } else if (!tokens_.blocks.empty()) {
    tokens_.blocks.back().lines.push_back({substitute(line, location), location});
  } else if (!told_stray_data_) {
    told_stray_data_ = true;
    diagnostics_.error(location, "",
                       "data before the first keyword; a deck starts with a keyword line such as *HEADING");
  }
}

void Tokenizer::parameter_line(std::string_view line, Location location) {
  line = trim(line.substr(0, line.find('#')));  // Abaqus takes the rest for a remark, as Python does
  if (line.empty()) return;
  const auto equals = line.find('=');
  if (equals == std::string_view::npos) {
    diagnostics_.error(location, "PARAMETER", fmt::format("'{}' is no assignment; write NAME = EXPRESSION", line));
    return;
  }
  const std::string name = squeeze(line.substr(0, equals));
  try {
    parameters_[name] = evaluate(line.substr(equals + 1), parameters_);
  } catch (const std::invalid_argument& trouble) {
    parameters_[name] = 0.0;  // told once, here
    diagnostics_.error(location, "PARAMETER",
                       fmt::format("the expression of {} cannot be evaluated: {}; allowed are numbers, "
                                   "parameters, + - * / **, parentheses and SQRT, SIN, COS, TAN, EXP, "
                                   "LOG, ABS",
                                   name, trouble.what()));
  }
}

std::string_view Tokenizer::substitute(std::string_view line, Location location) {
  auto open = line.find('<');
  if (open == std::string_view::npos) return line;
  std::string result;
  while (open != std::string_view::npos) {
    const auto close = line.find('>', open);
    if (close == std::string_view::npos) break;
    const std::string name = squeeze(line.substr(open + 1, close - open - 1));
    const auto found = parameters_.find(name);
    if (found == parameters_.end()) {
      std::vector<std::string> names;
      for (const auto& [known, value] : parameters_) names.push_back(known);
      diagnostics_.error(location, "PARAMETER",
                         fmt::format("<{}> has no value{}; assign it under *PARAMETER above this line", name,
                                     did_you_mean(name, names)));
      parameters_[name] = 0.0;
    }
    result += line.substr(0, open);
    result += fmt::format("{}", parameters_[name]);
    line.remove_prefix(close + 1);
    open = line.find('<');
  }
  result += line;
  tokens_.texts.push_back(std::move(result));
  return tokens_.texts.back();
}

}  // namespace

const Parameter* Block::find(std::string_view name) const {
  const std::string squeezed = squeeze(name);
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == squeezed; });
  return found == parameters.end() ? nullptr : &*found;
}

std::string Block::value(std::string_view name, std::string otherwise) const {
  const Parameter* parameter = find(name);
  return parameter != nullptr && parameter->has_value ? parameter->value : std::move(otherwise);
}

double Block::real(std::string_view name, double otherwise) const {
  const Parameter* parameter = find(name);
  return parameter != nullptr && parameter->has_value ? parse_real(parameter->value).value_or(otherwise) : otherwise;
}

std::int32_t Block::integer(std::string_view name, std::int32_t otherwise) const {
  const Parameter* parameter = find(name);
  if (parameter == nullptr || !parameter->has_value) return otherwise;
  return static_cast<std::int32_t>(parse_integer(parameter->value).value_or(otherwise));
}

Tokens tokenize(const std::string& path, const FileLoader& loader, Diagnostics& diagnostics) {
  Tokenizer tokenizer(loader, diagnostics);
  tokenizer.read(path, {}, "");
  return tokenizer.take();
}

}  // namespace balocco::deck
