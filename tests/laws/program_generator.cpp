// A small grammar of macro programs, drawn from at random.
#include "laws/program_generator.h"

#include <algorithm>

namespace feedhold::laws {

namespace {

using rc::gen::element;
using rc::gen::inRange;

constexpr std::string_view kInteresting = "XYZGMNOPQ#[]=+-*/()%;,.:<>019 \r\n\tEQGOTOIFTHENWHILEDOEND";

void append(BlockPieces &to, const BlockPieces &pieces) { to.insert(to.end(), pieces.begin(), pieces.end()); }

std::string integer(int limit) { return std::to_string(*inRange(0, limit)); }

std::string number() {
  return *element<std::string>("0", "1", "12", "1.5", ".5", "100.", "0.001", "9999", "-2.5", "-3");
}

BlockPieces expression(int depth);

BlockPieces bracketed(int depth) {
  BlockPieces pieces{"["};
  append(pieces, expression(depth));
  pieces.push_back("]");
  return pieces;
}

BlockPieces variable(int depth) {
  BlockPieces pieces{"#"};
  if (depth > 0 && *inRange(0, 6) == 0)
    append(pieces, bracketed(depth - 1));
  else
    pieces.push_back(integer(1000));
  return pieces;
}

BlockPieces operand(int depth) {
  const int choice = depth > 0 ? *inRange(0, 5) : *inRange(0, 2);
  if (choice == 0)
    return {integer(1000)};
  if (choice == 1 || choice == 2)
    return variable(depth);
  if (choice == 3)
    return bracketed(depth - 1);
  BlockPieces pieces{*element<std::string>("SIN", "COS", "SQRT", "ABS", "ROUND", "FIX", "FUP")};
  append(pieces, bracketed(depth - 1));
  return pieces;
}

BlockPieces expression(int depth) {
  BlockPieces pieces = operand(depth);
  for (int terms = *inRange(0, 3); terms > 0; --terms) {
    pieces.push_back(*element<std::string>("+", "-", "*", "/", "MOD"));
    append(pieces, operand(depth));
  }
  return pieces;
}

BlockPieces condition() {
  BlockPieces pieces{"["};
  append(pieces, operand(1));
  pieces.push_back(*element<std::string>("EQ", "NE", "LT", "LE", "GT", "GE"));
  append(pieces, expression(1));
  pieces.push_back("]");
  return pieces;
}

BlockPieces words() {
  BlockPieces pieces{*element<std::string>("G0", "G01", "G2", "M8", "S800", "T1")};
  for (int count = *inRange(0, 4); count > 0; --count) {
    pieces.push_back(*element<std::string>("X", "Y", "Z", "I", "J", "F", "R"));
    if (*inRange(0, 3) > 0)
      pieces.push_back(number());
    else
      append(pieces, *inRange(0, 2) == 0 ? variable(1) : bracketed(2));
  }
  return pieces;
}

BlockPieces assignment() {
  BlockPieces pieces = variable(1);
  pieces.push_back("=");
  append(pieces, expression(2));
  return pieces;
}

BlockPieces branch() {
  BlockPieces pieces{"IF"};
  append(pieces, condition());
  if (*inRange(0, 2) == 0)
    append(pieces, {"GOTO", integer(100)});
  else {
    pieces.push_back("THEN");
    append(pieces, assignment());
  }
  return pieces;
}

BlockPieces loop() {
  BlockPieces pieces{"WHILE"};
  append(pieces, condition());
  append(pieces, {"DO", *element<std::string>("1", "2", "3")});
  return pieces;
}

BlockPieces call() {
  BlockPieces pieces{"G65", "P", integer(9999), "A"};
  append(pieces, variable(0));
  append(pieces, {"B", number()});
  return pieces;
}

BlockPieces block() {
  BlockPieces pieces;
  if (*inRange(0, 8) == 0)
    pieces.push_back("/");
  if (*inRange(0, 4) == 0)
    append(pieces, {"N", integer(1000)});
  switch (*inRange(0, 9)) {
  case 0: append(pieces, assignment()); break;
  case 1: append(pieces, branch()); break;
  case 2: append(pieces, loop()); break;
  case 3: append(pieces, {"END", *element<std::string>("1", "2", "3")}); break;
  case 4: append(pieces, call()); break;
  case 5: append(pieces, {"GOTO", integer(100)}); break;
  case 6: append(pieces, {"M", "98", "P", integer(9999)}); break;
  default: append(pieces, words()); break;
  }
  if (*inRange(0, 6) == 0)
    pieces.push_back(*element<std::string>("(TEXT)", "(IF [#1] X2)", "()"));
  return pieces;
}

// ---- o-words -----------------------------------------------------------------------------------------------------

std::string label() { return *element<std::string>("1", "2", "100", "<a>", "<b c>"); }

BlockPieces oWord(const std::string &of, const std::string &word) { return {"o", of, word}; }

BlockPieces oWordWithValue(const std::string &of, const std::string &word) {
  BlockPieces pieces = oWord(of, word);
  append(pieces, bracketed(2));
  return pieces;
}

BlockPieces oWordCall() {
  BlockPieces pieces = oWord(label(), "call");
  for (int count = *inRange(0, 3); count > 0; --count)
    append(pieces, bracketed(1));
  return pieces;
}

BlockPieces plainOWordBlock() {
  switch (*inRange(0, 5)) {
  case 0: return oWordCall();
  case 1: return words();
  case 2: return oWord(label(), *element<std::string>("break", "continue", "return", "else"));
  case 3: {
    BlockPieces pieces{"#", *element<std::string>("<a>", "<_b>", "7"), "="};
    append(pieces, bracketed(2));
    return pieces;
  }
  default: return {"g1", "x1", *element<std::string>("; up", "(TEXT)", ";")};
  }
}

void appendConstruct(ProgramPieces &program, int depth) {
  const std::string of = label();
  const int kind = *inRange(0, depth > 0 ? 5 : 1);
  const auto body = [&] {
    for (int count = *inRange(0, 3); count > 0; --count)
      appendConstruct(program, depth - 1);
  };
  if (kind == 0) {
    program.push_back(plainOWordBlock());
    return;
  }
  if (kind == 3) {
    program.push_back(oWord(of, "do"));
    body();
    program.push_back(oWordWithValue(of, "while"));
    return;
  }
  const std::string name = kind == 1 ? "if" : kind == 2 ? "while" : "repeat";
  program.push_back(oWordWithValue(of, name));
  body();
  program.push_back(oWord(of, "end" + name));
}

} // namespace

rc::Gen<ProgramPieces> oWordPieces() {
  return rc::gen::exec([] {
    ProgramPieces program;
    for (int subs = *inRange(0, 3); subs > 0; --subs) {
      const std::string of = label();
      program.push_back(oWord(of, "sub"));
      appendConstruct(program, 2);
      program.push_back(oWord(of, "endsub"));
    }
    for (int count = *inRange(0, 4); count > 0; --count)
      appendConstruct(program, 2);
    program.push_back({"m2"});
    return program;
  });
}

rc::Gen<ProgramPieces> programPieces() {
  return rc::gen::exec([] {
    ProgramPieces program{{"O", std::to_string(*inRange(1, 9999))}};
    for (int blocks = *inRange(0, 12); blocks > 0; --blocks)
      program.push_back(block());
    program.push_back({"M99"});
    return program;
  });
}

std::string join(const ProgramPieces &program, std::string_view between, std::string_view endOfBlock) {
  std::string text;
  for (const BlockPieces &pieces : program) {
    for (const std::string &piece : pieces)
      text.append(piece).append(between);
    text.append(endOfBlock);
  }
  return text;
}

rc::Gen<std::string> mutated(std::string text) {
  return rc::gen::exec([text] {
    std::string bytes = text;
    for (int count = *inRange(1, 6); count > 0 && !bytes.empty(); --count) {
      const auto at = static_cast<std::size_t>(*inRange<int>(0, static_cast<int>(bytes.size())));
      const char other = kInteresting[static_cast<std::size_t>(*inRange<int>(0, kInteresting.size()))];
      switch (*inRange(0, 3)) {
      case 0: bytes.erase(at, static_cast<std::size_t>(*inRange(1, 4))); break;
      case 1: bytes.insert(at, 1, other); break;
      default: bytes[at] = other; break;
      }
    }
    return bytes;
  });
}

} // namespace feedhold::laws
