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

std::vector<RecordedMove> movesOfTip(const RecordedMove &recorded) {
  std::vector<RecordedMove> moves = movesOfCentre(recorded);
  for (RecordedMove &each : moves)
    if (!recorded.centre.empty())
      each.move = displaced(each.move, recorded.tip, [](ConcreteValue &value, double by) { value.number += by; });
  return moves;
}

} // namespace feedhold
