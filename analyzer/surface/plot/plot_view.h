// PlotView: a part of space, seen along one axis, on a part of the picture.  Internal to sink/.
#pragma once

#include "proof/geometry/gouge_path.h"

#include <string>
#include <vector>

namespace feedhold {

/// What is shown of an axis.
struct PlotRange {
  double low = 0;
  double high = 0;
  double size() const { return high - low; }
  void include(double value);
};

struct PlotView {
  Axis across;
  Axis up;
  PlotRange acrossRange;
  PlotRange upRange;
  double scale;         // of the picture's units to those of length
  double left, top;     // of the view, in the picture
  bool isLathe = false; // across is Z, and up the radius, of which the scale shows diameters (half_plane.h)

  double width() const { return acrossRange.size() * scale; }
  double height() const { return upRange.size() * scale; }
  // From the left and the top of the view.
  double x(double value) const { return (value - acrossRange.low) * scale; }
  double y(double value) const { return (upRange.high - value) * scale; }
  double x(const geometry::Point<double> &point) const { return x(point[indexOf(across)]); }
  double y(const geometry::Point<double> &point) const { return y(point[indexOf(up)]); }
};

/// A number of the picture: two decimals, no more of them than it takes.
std::string px(double value);
/// A length or a coordinate: up to four decimals.
std::string plainNumber(double value);

/// A move for the attribute `d` of a path, without the step to its start.
std::string pathOf(const PlotView &view, const RecordedMove &recorded);

/// Elements that are said to be of a class, drawn where they can be seen.
std::string drawShape(const PlotView &view, const geometry::PlainShape &shape, std::string_view attributes);
std::string drawTool(const PlotView &view, const geometry::Tool<double> &tool, const geometry::Point<double> &point);
std::string drawAxes(const PlotView &view, std::string_view unit);
void include(std::array<PlotRange, 3> &ranges, const geometry::PlainShape &shape);

} // namespace feedhold
