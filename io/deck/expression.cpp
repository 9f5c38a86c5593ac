#include "deck/expression.hpp"

#include <cctype>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "deck/text.hpp"

namespace balocco::deck {

namespace {

/// Recursive descent; each function consumes what it understands.
class Parser {
 public:
  Parser(std::string_view text, const ParameterValues& values) : rest_(text), values_(values) {}

  double whole() {
    const double value = sum();
    if (!peek().empty()) throw std::invalid_argument("'" + std::string(peek()) + "' is left over");
    if (!std::isfinite(value)) throw std::invalid_argument("the value is not finite");
    return value;
  }

 private:
  std::string_view peek() {
    rest_ = trim(rest_);
    return rest_;
  }

  bool take(std::string_view token) {
    if (!peek().starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  double sum() {
    double value = product();
    for (;;) {
      if (take("+")) {
        value += product();
      } else if (take("-")) {
        value -= product();
      } else {
        return value;
      }
    }
  }

  double product() {
    double value = factor();
    for (;;) {
      if (peek().starts_with("**")) return value;
      if (take("*")) {
        value *= factor();
      } else if (take("/")) {
        value /= factor();
      } else {
        return value;
      }
    }
  }

  double factor() {
    if (take("-")) return -factor();
    if (take("+")) return factor();
    const double base = atom();
    return take("**") ? std::pow(base, factor()) : base;
  }

  double atom() {
    if (take("(")) {
      const double value = sum();
      if (!take(")")) throw std::invalid_argument("')' is missing");
      return value;
    }
    if (peek().empty()) throw std::invalid_argument("a value is missing");
    return std::isalpha(static_cast<unsigned char>(rest_[0])) || rest_[0] == '_' ? named() : number();
  }

  double number() {
    std::size_t size = 0;
    while (size < rest_.size()) {
      const char c = rest_[size];
      const bool sign = (c == '+' || c == '-') && size > 0 && std::string_view("eEdD").find(rest_[size - 1]) < 4;
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && !sign) break;
      ++size;
    }
    const auto value = parse_real(rest_.substr(0, size));
    if (!value) throw std::invalid_argument("'" + std::string(rest_) + "' is not a number");
    rest_.remove_prefix(size);
    return *value;
  }

  double named() {
    std::size_t size = 0;
    while (size < rest_.size() && (std::isalnum(static_cast<unsigned char>(rest_[size])) || rest_[size] == '_')) ++size;
    const std::string name = upper(rest_.substr(0, size));
    rest_.remove_prefix(size);
    if (take("(")) {
      const double argument = sum();
      if (!take(")")) throw std::invalid_argument("')' is missing");
      return call(name, argument);
    }
    if (const auto found = values_.find(name); found != values_.end()) return found->second;
    if (name == "PI") return std::numbers::pi;
    throw std::invalid_argument("parameter " + name + " has no value yet");
  }

  static double call(const std::string& name, double argument) {
    using Function = double (*)(double);
    static const std::map<std::string, Function> functions{
        {"SQRT", [](double x) { return std::sqrt(x); }}, {"SIN", [](double x) { return std::sin(x); }},
        {"COS", [](double x) { return std::cos(x); }},   {"TAN", [](double x) { return std::tan(x); }},
        {"EXP", [](double x) { return std::exp(x); }},   {"LOG", [](double x) { return std::log(x); }},
        {"ABS", [](double x) { return std::abs(x); }}};
    const auto found = functions.find(name);
    if (found == functions.end()) throw std::invalid_argument("function " + name + " is not known");
    return found->second(argument);
  }

  std::string_view rest_;
  const ParameterValues& values_;
};

}  // namespace

double evaluate(std::string_view expression, const ParameterValues& values) {
  return Parser(expression, values).whole();
}

}  // namespace balocco::deck
