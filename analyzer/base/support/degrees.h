// Angles in degrees: the functions of a control, exact at multiples of 90 where libm in radians is not.
#pragma once

namespace feedhold {

/// The angle is first brought into a quarter turn, which is exact; so the error stays near one unit in the last
/// place for an angle of any size.
double sinDegrees(double angle);
double cosDegrees(double angle);
/// Infinite at odd multiples of 90.
double tanDegrees(double angle);

/// In [-90, 90]; NaN outside [-1, 1].
double asinDegrees(double sine);
/// In [0, 180]; NaN outside [-1, 1].
double acosDegrees(double cosine);
/// In [-90, 90].
double atanDegrees(double tangent);
/// In (-180, 180]; 0 for the origin.
double atan2Degrees(double y, double x);

} // namespace feedhold
