// CutterBlock: what an executed block is to cutter compensation.
#pragma once

#include "meaning/machine/cutter_geometry.h"
#include "meaning/semantics/executed_words.h"

#include <functional>

namespace feedhold {

struct CutterBlock {
  /// The codes and D ask for compensation on this side, seen along the path as the machine makes it (mirror images
  /// swap the sides); absent: none.  Radius 0 where `whyNoRadius`.
  std::optional<CutterSide> side;
  std::string_view whyNoRadius = {}; // the offset is not known; empty: it is
  bool offsetIsAssumed = false;
  Plane plane = kPlaneXY;
  bool switches = false; // G41 or G42 stands in the block
  bool stopsReading = false;
  bool namesPlane = false; // has words for the axes of the plane
  /// Why the block is not followed where the compensation is in force; empty: it is.
  std::string_view foreign = {};
};

/// `otherwise`: the offset that nothing gives; absent: such a path is not followed.
CutterBlock cutterBlockOf(StepContext<ConcreteInterpretation> &context,
                          const ExecutedWords<ConcreteInterpretation> &words,
                          const std::function<std::optional<double>()> &otherwise);

/// G41 or G42 is in force, or a code of their group that is not followed.
bool mayCompensate(StepContext<ConcreteInterpretation> &context);

} // namespace feedhold
