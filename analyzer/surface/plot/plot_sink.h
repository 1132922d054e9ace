// Pictures of runs: one SVG with a plan and a side view, without script and without other files.
#pragma once

#include "proof/geometry/gouge.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace feedhold {

struct PlottedRun {
  std::string name; // in the legend, where there are several
  std::span<const RecordedMove> moves;
  /// What is said of a move to who points at it; null: nothing.
  std::function<std::string(const RecordedMove &)> blockOf = nullptr;
};

struct PlottedGouge {
  geometry::Gouge gouge; // of the first run
  std::string text;      // gougeText
};

struct Picture {
  std::string title;
  std::vector<std::string> notes = {}; // below the title
  std::vector<PlottedRun> runs;        // one, or two over each other
  geometry::PlainSpace space = {};
  bool isLathe = false; // its moves have X as a diameter, and its space is that of half_plane.h
  std::optional<PlottedGouge> gouge = std::nullopt;
};

/// X Y from above, X Z from the front, and both again near a gouge; of a lathe Z X alone.  Scales are in the unit of
/// the first move.
std::string drawPicture(const Picture &picture);

/// `0.25 mm outside of CAVITY at N40`; `place`: `N40`, `line 7`.
std::string gougeText(const geometry::PlainSpace &space, geometry::SpaceClaim claim, std::size_t region,
                      const geometry::Gouge &gouge, LengthUnit unit, std::string_view place);

} // namespace feedhold
