#include "materials/elastic_by_temperature.hpp"

#include "model/model.hpp"

namespace balocco {

bool ElasticTable::is_in(const Material& material) { return material.law == "elastic" && material.parameters.size() > 2; }

IsotropicElastic ElasticTable::at(double temperature) const {
  const std::size_t rows = parameters_.size() / columns;
  std::size_t above = 0;
  while (above < rows && value(above, 2) <= temperature) ++above;
  const std::size_t high = std::min(above, rows - 1), low = above == 0 ? 0 : above - 1;
  const double part = low == high ? 0.0 : (temperature - value(low, 2)) / (value(high, 2) - value(low, 2));
  const auto between = [&](std::size_t column) { return value(low, column) + part * (value(high, column) - value(low, column)); };
  return IsotropicElastic::from_young(between(0), between(1));
}

IsotropicElastic ElasticTable::greatest() const {
  double young = value(0, 0), most = value(0, 1), least = value(0, 1);
  for (std::size_t row = 1; row < parameters_.size() / columns; ++row) {
    young = std::max(young, value(row, 0));
    most = std::max(most, value(row, 1));
    least = std::min(least, value(row, 1));
  }
  return {std::max(IsotropicElastic::from_young(young, most).lambda, 0.0), IsotropicElastic::from_young(young, least).mu};
}

bool follows_temperature(const Material& material) { return material.expansion.has_value() || ElasticTable::is_in(material); }

ElasticByTemperature::ElasticByTemperature(const ElasticTable& table)
    : lambda(table.first().lambda), mu(table.first().mu), greatest_lambda(table.greatest().lambda), greatest_mu(table.greatest().mu) {}

}  // namespace balocco
