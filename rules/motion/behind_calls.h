// What becomes, behind the calls of a program, of a mode that it leaves on.
#pragma once

#include "rules/motion/left_on.h"

namespace feedhold::rules {

enum class BehindCalls : std::uint8_t {
  NotKnown,  // no checked program calls this one
  PutRight,  // each caller puts the mode right, or ends the program in a way that does
  LeftAtEnd, // some caller comes to its end with it, without moving
  MovesOn,   // some caller moves on with it up to its end
};
struct CallersOfMode {
  BehindCalls behind = BehindCalls::NotKnown;
  BehindCalls behindLocal = BehindCalls::NotKnown; // of M97 alone; a caller that has the mode on itself keeps it
  bool allInFile = false; // the calls stand in the file of the program: no others are to be expected
};
CallersOfMode behindCalls(const LeftOn &mode, const FlowFacts &facts, const FileContext &context);

} // namespace feedhold::rules
