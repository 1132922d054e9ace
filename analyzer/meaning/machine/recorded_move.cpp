#include "meaning/machine/recorded_move.h"

namespace feedhold {

std::vector<RecordedMove> movesOfCentre(const RecordedMove &recorded) {
  if (recorded.centre.empty())
    return {recorded};
  std::vector<RecordedMove> moves;
  for (const Move<ConcreteValue> &move : recorded.centre) {
    moves.push_back({move, recorded.unit, recorded.place, recorded.own, recorded.zero, recorded.machineZero,
                     recorded.isOfTool, recorded.isOfToolButForLength, recorded.length, recorded.isOfAxes});
  }
  return moves;
}

} // namespace feedhold
