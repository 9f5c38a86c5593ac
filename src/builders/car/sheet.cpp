#include "builders/car/sheet.hpp"

#include <algorithm>
#include <cmath>

namespace balocco::car {
namespace {

/// An outline in a member's cross-section: (across, out), straight from corner to corner.
struct Outline {
  std::vector<std::array<double, 2>> corners;
  bool closed = false;
};

std::array<double, 2> point_of(const Outline& outline, double station) {
  const auto count = outline.corners.size();
  const auto i = std::min(static_cast<std::size_t>(station), count - (outline.closed ? 1 : 2));
  const double part = station - static_cast<double>(i);
  const auto &a = outline.corners[i], &b = outline.corners[(i + 1) % count];
  return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
}

/// Stations of an outline: corner i is at i, with as many between as the longest member's outline asks for.
std::vector<double> stations_of(const Outline& outline, double size) {
  std::vector<double> all{0.0};
  const auto count = outline.corners.size();
  for (std::size_t i = 0; i + (outline.closed ? 0 : 1) < count; ++i) {
    const auto &a = outline.corners[i], &b = outline.corners[(i + 1) % count];
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::hypot(b[0] - a[0], b[1] - a[1]) / size - 1e-6)));
    for (int k = 1; k <= pieces; ++k) all.push_back(static_cast<double>(i) + static_cast<double>(k) / pieces);
  }
  if (outline.closed) all.pop_back();
  return all;
}

Sheet sweep(const std::string& part, const std::vector<Frame>& member, const std::function<Outline(double)>& outline_at,
            double size) {
  const auto start = outline_at(0.0), end = outline_at(1.0);
  auto across = stations_of(start, size);
  if (const auto of_end = stations_of(end, size); of_end.size() > across.size()) across = of_end;
  Sheet sheet{
      .part = part, .rows = static_cast<int>(member.size()), .columns = static_cast<int>(across.size()), .closed = start.closed};
  for (std::size_t row = 0; row < member.size(); ++row) {
    const auto outline = outline_at(static_cast<double>(row) / static_cast<double>(member.size() - 1));
    for (const double station : across) {
      const auto [aside, out] = point_of(outline, station);
      sheet.points.push_back(member[row].place + aside * member[row].across + out * member[row].out);
    }
  }
  return sheet;
}

}  // namespace

Sheet sheet_on(const std::string& part, const std::vector<double>& u, const std::vector<double>& v, const Surface& surface) {
  Sheet sheet{.part = part, .rows = static_cast<int>(u.size()), .columns = static_cast<int>(v.size())};
  for (const double along : u)
    for (const double across : v) sheet.points.push_back(surface(along, across));
  return sheet;
}

Sheet between(const std::string& part, const Curve& first, const Curve& second, double size) {
  double widest = 0.0;
  for (int i = 0; i <= 8; ++i)
    widest = std::max(widest, length(second.at(second.length() * i / 8) - first.at(first.length() * i / 8)));
  const double longest = std::max(first.length(), second.length());
  return sheet_on(part, stations({0.0, 1.0}, size / longest), stations({0.0, 1.0}, size / widest), [&](double u, double v) {
    return (1.0 - v) * first.at(u * first.length()) + v * second.at(u * second.length());
  });
}

std::vector<Frame> frames(const Curve& line, double size, const std::function<Vector(const Vector&)>& outward) {
  std::vector<Frame> all;
  const auto at = stations({0.0, line.length()}, size);
  const double near = std::min(0.25 * size, 0.02 * line.length());
  for (const double s : at) {
    Frame frame{.place = line.at(s)};
    frame.along = unit(line.at(std::min(s + near, line.length())) - line.at(std::max(s - near, 0.0)));
    const auto out = outward(frame.place);
    frame.out = unit(out - dot(out, frame.along) * frame.along);
    frame.across = cross(frame.along, frame.out);
    all.push_back(frame);
  }
  return all;
}

Sheet hat_along(const std::string& part, const std::vector<Frame>& member, const Hat& hat, double size) {
  const double end_width = hat.end_width > 0.0 ? hat.end_width : hat.width;
  return sweep(part, member, [&](double along) {
    const double half = 0.5 * (hat.width + along * (end_width - hat.width)), edge = half + hat.flange;
    return Outline{{{-edge, 0.0}, {-half, 0.0}, {-half, hat.depth}, {half, hat.depth}, {half, 0.0}, {edge, 0.0}}, false};
  }, size);
}

Sheet tube_along(const std::string& part, const std::vector<Frame>& member, double width, double height, double size) {
  const double aside = 0.5 * width, out = 0.5 * height;
  return sweep(
      part, member,
      [&](double) {
        return Outline{{{-aside, -out}, {-aside, out}, {aside, out}, {aside, -out}}, true};
      },
      size);
}

Sheet mirrored(const Sheet& sheet, const std::string& part) {
  Sheet other = sheet;
  other.part = part;
  other.turned = !sheet.turned;
  for (auto& point : other.points) point = mirrored(point);
  return other;
}

}  // namespace balocco::car
