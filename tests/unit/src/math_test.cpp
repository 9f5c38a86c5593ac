#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include "math/dual.hpp"
#include "math/exact_sum.hpp"
#include "math/pack.hpp"
#include "math/tensor.hpp"

namespace balocco {
namespace {

std::vector<double> wild_numbers(int count, int exponents) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-exponents, exponents);
  std::vector<double> numbers(count);
  for (double& number : numbers) number = std::ldexp(mantissa(random), exponent(random));
  return numbers;
}

double exact_sum(const std::vector<double>& addends) {
  ExactSum sum;
  for (const double addend : addends) sum.add(addend);
  return sum.value();
}

TEST(ExactSum, CancellationLeavesTheSmallAddend) {
  EXPECT_EQ(exact_sum({1e300, 1.0, -1e300}), 1.0);
  EXPECT_EQ(exact_sum({1e16, 1e-16, -1e16}), 1e-16);
  EXPECT_EQ(exact_sum({}), 0.0);
  EXPECT_EQ(exact_sum({-3.5}), -3.5);
}

TEST(ExactSum, WholeRangeOfDoubles) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(exact_sum({least}), least);
  EXPECT_EQ(exact_sum({least, least, -least}), least);
  const double large = std::ldexp(1.0, 1022);
  EXPECT_EQ(exact_sum({large, least, -large}), least);
  EXPECT_EQ(exact_sum({std::numeric_limits<double>::max(), 1.0}), std::numeric_limits<double>::max());
  EXPECT_EQ(exact_sum({-std::numeric_limits<double>::max()}), -std::numeric_limits<double>::max());
}

TEST(ExactSum, EachDoubleComesBackUnchanged) {
  for (const double number : wild_numbers(2000, 1000)) ASSERT_EQ(exact_sum({number}), number);
}

// Addends of like size: 64 bits of mantissa hold their sum exactly (53 bits + 10 bits of count).
TEST(ExactSum, AgreesWithLongDoubleWhereThatIsExact) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> range(1.0, 2.0);
  ExactSum sum;
  long double reference = 0.0L;
  for (int i = 0; i < 1000; ++i) {
    const double addend = range(random);
    sum.add(addend);
    reference += addend;
  }
  EXPECT_NEAR(sum.value(), static_cast<double>(reference), std::nextafter(2048.0, 4096.0) - 2048.0);
}

TEST(ExactSum, AnyOrderAndAnySplitGiveTheSameBits) {
  auto numbers = wild_numbers(5000, 200);
  const double forward = exact_sum(numbers);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937_64(3));
  EXPECT_EQ(exact_sum(numbers), forward);

  ExactSum parts[3];
  for (std::size_t i = 0; i < numbers.size(); ++i) parts[i % 3].add(numbers[i]);
  for (int i = 0; i < ExactSum::word_count; ++i) parts[0].words()[i] += parts[1].words()[i] + parts[2].words()[i];
  EXPECT_EQ(parts[0].value(), forward);
}

TEST(ExactSum, ClearForgets) {
  ExactSum sum;
  sum.add(3.0);
  sum.clear();
  sum.add(0.25);
  EXPECT_EQ(sum.value(), 0.25);
}

TEST(ExactSum, ABlownUpAddendIsNotHidden) {
  EXPECT_TRUE(std::isnan(exact_sum({1.0, std::numeric_limits<double>::infinity()})));
  EXPECT_TRUE(std::isnan(exact_sum({std::numeric_limits<double>::quiet_NaN(), 2.0})));
  ExactSum good, bad;
  good.add(1.0);
  bad.add(-std::numeric_limits<double>::infinity());
  for (int i = 0; i < ExactSum::word_count; ++i) good.words()[i] += bad.words()[i];
  EXPECT_TRUE(std::isnan(good.value()));
}

TEST(Rounded, ConstantIsThreeHalvesOfAPowerOfTwoWithTheStatedQuantum) {
  for (const double largest : {1.0, 0.75, 3.0e5, 1.7e-9}) {
    const double constant = rounding_constant(largest);
    const double quantum = std::nextafter(constant, 2.0 * constant) - constant;
    EXPECT_EQ(constant, std::ldexp(1.5, 52) * quantum);
    EXPECT_GE(quantum, std::ldexp(largest, -51));
    EXPECT_LE(quantum, std::ldexp(largest, -50));
  }
}

TEST(Rounded, AddendBecomesTheNearestMultipleOfTheQuantum) {
  const double constant = rounding_constant(1000.0);
  const double quantum = std::nextafter(constant, 2.0 * constant) - constant;
  for (const double number : {999.123456789, -0.1, 1e-20, -512.0, 0.3 * quantum, -2.7 * quantum}) {
    const double result = rounded(number, constant);
    EXPECT_EQ(result, quantum * std::nearbyint(number / quantum));
    EXPECT_LE(std::abs(result - number), 0.5 * quantum);
  }
}

TEST(Rounded, SumsAreAssociative) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> range(-1.0, 1.0);
  std::vector<double> addends(1000);
  for (double& addend : addends) addend = range(random) * std::pow(10.0, -9.0 * std::abs(range(random)));
  const double constant = rounding_constant(1000.0);
  const auto sum = [&] {
    double total = 0.0;
    for (const double addend : addends) total += rounded(addend, constant);
    return total;
  };
  const double first = sum();
  for (int order = 0; order < 20; ++order) {
    std::shuffle(addends.begin(), addends.end(), random);
    ASSERT_EQ(sum(), first);
  }
  std::reverse(addends.begin(), addends.end());
  EXPECT_EQ(rounded(first, constant), first);
}

TEST(Rounded, PackEqualsScalar) {
  const double constant = rounding_constant(37.0);
  alignas(64) double numbers[pack_size], results[pack_size];
  for (int i = 0; i < pack_size; ++i) numbers[i] = std::sin(10.0 * i);
  store(rounded(load(numbers), Pack(constant)), results);
  for (int i = 0; i < pack_size; ++i) EXPECT_EQ(results[i], rounded(numbers[i], constant));
}

template <class T>
T long_expression(const T& x, const T& y) {
  T sum = 2.0 * x - y / 3.0 + (1.0 - x) * (y + 4.0) - 5.0 / y + (-x) / y;
  sum += x * y;
  sum -= x;
  sum *= y;
  return sum + square_root(x * x + y * y) + maximum(x, y) + select(x < y, x, y);
}

// Central differences of step h err by h^2 f'''/6: here about 1e-10.
TEST(Dual, DerivativesAgreeWithDifferences) {
  const double x = 0.7, y = 1.9, h = 1e-5;
  const auto dual = long_expression(Dual<2>(x, 0), Dual<2>(y, 1));
  EXPECT_DOUBLE_EQ(dual.value, long_expression(x, y));
  EXPECT_NEAR(dual.derivative[0], (long_expression(x + h, y) - long_expression(x - h, y)) / (2 * h), 1e-8);
  EXPECT_NEAR(dual.derivative[1], (long_expression(x, y + h) - long_expression(x, y - h)) / (2 * h), 1e-8);
}

TEST(Dual, ConstantsHaveNoDerivativeAndBranchesFollowValues) {
  const Dual<2> constant = 3.0, variable(2.0, 1);
  EXPECT_EQ(constant.derivative[0], 0.0);
  EXPECT_EQ(constant.derivative[1], 0.0);
  EXPECT_TRUE(variable < constant);
  EXPECT_TRUE(constant > variable);
  EXPECT_EQ(maximum(variable, constant).derivative[1], 0.0);
  EXPECT_EQ(select(true, variable, constant).derivative[1], 1.0);
  EXPECT_EQ(value_of(variable), 2.0);
  EXPECT_EQ(value_of(2.5), 2.5);
}

const Matrix3<double> matrix{{2.0, -1.0, 0.5, 0.25, 3.0, -2.0, 1.0, 0.5, 4.0}};

TEST(Tensor, CofactorIsDeterminantTimesInverseTransposed) {
  const auto cofactors = cofactor(matrix);
  const double det = determinant(matrix, cofactors);
  EXPECT_DOUBLE_EQ(det, 27.5625);  // by hand, along the first row
  const auto product = matrix * transpose(cofactors);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(product(i, j), i == j ? det : 0.0, 1e-14);
}

TEST(Tensor, CofactorIsTheDerivativeOfTheDeterminant) {
  Matrix3<Dual<9>> variable;
  for (int i = 0; i < 9; ++i) variable.component[i] = Dual<9>(matrix.component[i], i);
  const auto det = determinant(variable, cofactor(variable));
  const auto expected = cofactor(matrix);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(det.derivative[i], expected.component[i], 1e-14);
}

TEST(Tensor, VectorsAndProducts) {
  const Vector3<double> a{1.0, 2.0, 3.0}, b{-2.0, 0.5, 4.0};
  EXPECT_EQ(dot(a, b), 11.0);
  EXPECT_EQ(cross(a, b).component, (std::array<double, 3>{6.5, -10.0, 4.5}));
  EXPECT_EQ((matrix * a).component, (std::array<double, 3>{1.5, 0.25, 14.0}));
  EXPECT_EQ((2.0 * a - b).component, (std::array<double, 3>{4.0, 3.5, 2.0}));
  EXPECT_EQ((Matrix3<double>::identity() * matrix).component, matrix.component);
  EXPECT_EQ(transpose(matrix)(0, 1), matrix(1, 0));
  EXPECT_EQ(double_contraction(matrix, Matrix3<double>::identity()), 9.0);
}

TEST(Pack, HelpersEqualTheirScalarForms) {
  alignas(64) double a[pack_size], b[pack_size], result[pack_size];
  for (int i = 0; i < pack_size; ++i) {
    a[i] = 1.0 + 0.3 * i;
    b[i] = 3.0 - 0.4 * i;
  }
  const Pack pa = load(a), pb = load(b);
  store(select(pa < pb, pa, pb), result);
  for (int i = 0; i < pack_size; ++i) EXPECT_EQ(result[i], select(a[i] < b[i], a[i], b[i]));
  store(square_root(pa), result);
  for (int i = 0; i < pack_size; ++i) EXPECT_EQ(result[i], square_root(a[i]));
  store(maximum(pa, pb), result);
  for (int i = 0; i < pack_size; ++i) EXPECT_EQ(result[i], maximum(a[i], b[i]));
}

}  // namespace
}  // namespace balocco
