// Eigenvalues and -vectors of K - lambda M around a shift, through SLEPc: Krylov-Schur iterations on a factorised
// K - shift M, whose negative pivots tell how many eigenvalues lie below the shift (Sylvester's law of inertia).
#pragma once

#include <vector>

#include "communicator.hpp"
#include "implicit_petsc.hpp"

namespace balocco {

/// What is looked for. Eigenvalues are circular frequencies squared.
struct EigenRange {
  double shift = 0.0;   // about which; not an eigenvalue
  double lowest = 0.0;  // the least of interest
  double highest = 0.0;
  int number = 0;  // at most, the lowest
};

struct EigenPair {
  double value = 0.0;
  std::vector<double> vector;  // of the equations that this rank owns
};

class Eigenmodes {
 public:
  /// `stiffness` symmetric, with as many rows of independent constraints as there are `multipliers`; `mass` symmetric, not negative,
  /// perhaps singular. Collective.
  Eigenmodes(Mat stiffness, Mat mass, int multipliers, const Communicator& communicator);

  /// Eigenvalues below `value`, which is none itself. @throws AnalysisError if the factorisation fails. Collective.
  int count_below(double value);
  /// The pairs in the range, in rising order: negative ones too, but for those far below all others. @throws AnalysisError. Collective.
  std::vector<EigenPair> find(EigenRange range);
  /// The lowest positive pairs, of a stiffness that resists every motion and any symmetric `mass`. @throws AnalysisError. Collective.
  std::vector<EigenPair> least_positive(int number);
  /// A value near zero against all that counts, and below the zeros of rigid motions. Collective.
  double small_shift() const;
  /// A value beyond all that counts. Collective.
  double great_shift() const { return -1e18 * small_shift(); }

 private:
  void factorize_shifted(double value, KSP solver);
  std::vector<EigenPair> search(const EigenRange& range);
  std::vector<EigenPair> nearest(double shift, int number, EPSProblemType type = EPS_GHEP);

  Mat stiffness_, mass_;
  int multipliers_;
  const Communicator& communicator_;
};

}  // namespace balocco
