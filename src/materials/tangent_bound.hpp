// What the stable increment needs to know of a law's tangent.
#pragma once

namespace balocco {

/// Bounds of the second variation of a solid's energy density: d2W <= volumetric (F^-T : dF)^2 + 2 shear dF : dF.
template <class T>
struct TangentBound {
  T volumetric, shear;
};

}  // namespace balocco
