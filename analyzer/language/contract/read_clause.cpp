// Reads one clause into its part of the contract.
#include "base/support/text.h"
#include "language/contract/clauses.h"
#include "language/model/block_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold {

namespace {

constexpr std::string_view kAxes = "XYZABCUVW";

constexpr std::string_view kClauseNames[] = {
#define CLAUSE(kind, name) name,
#include "language/contract/clauses.def"
};
constexpr std::string_view kUnitNames[] = {
#define UNIT(unit, name) name,
#include "language/contract/units.def"
};

class ReadClause {
public:
  ReadClause(ContractReading &reading, const RawClause &raw, ClauseId id, Span body)
      : reading_(reading), raw_(raw), id_(id), reader_(reading, id, body),
        contract_(contractOf(reading, reading.result.clauses[id].program)) {}

  void run() {
    read(reading_.result.clauses[id_].kind);
    if (!reader_.failed())
      return;
    contract_.isSound = false;
    addIssue(reading_, reader_.issue());
  }

private:
  void read(ClauseKind kind) {
    switch (kind) {
    case ClauseKind::Param: return entryValue(contract_.params);
    case ClauseKind::Global: return entryValue(contract_.globals);
    case ClauseKind::Require: return require();
    case ClauseKind::Modal: return modal();
    case ClauseKind::Start: return start();
    case ClauseKind::Tool: return tool();
    case ClauseKind::Offset: return offset();
    case ClauseKind::Length: return length();
    case ClauseKind::Machine: return machine();
    case ClauseKind::Corner: return corner();
    case ClauseKind::Fixed: return fixed();
    case ClauseKind::KeepIn: return region(contract_.keepIn);
    case ClauseKind::KeepOut: return region(contract_.keepOut);
    case ClauseKind::Clearance: return clearance();
    case ClauseKind::Travel: return travel();
    case ClauseKind::Limit: return limit();
    case ClauseKind::Ensure: return ensure();
    case ClauseKind::Tolerance: return tolerance();
    case ClauseKind::Assigns: return assigns();
    case ClauseKind::Guarded: return guarded();
    case ClauseKind::Alarm: return alarm();
    case ClauseKind::Invariant: return hint(contract_.invariants);
    case ClauseKind::Variant: return hint(contract_.variants);
    case ClauseKind::Eventually: return eventually();
    case ClauseKind::Cyclic: return mark(contract_.cyclic);
    }
  }

  /// The clause was read to its end without an issue.
  bool isRead() {
    reader_.expectEnd();
    return !reader_.failed();
  }
  template <typename Part> void setOnce(std::optional<Part> &place, Part part, std::string_view what) {
    if (place)
      return refuseSecond(place->clause, std::string(what));
    place = std::move(part);
  }
  void refuseSecond(ClauseId first, std::string what) {
    if (raw_.scope == SidecarScope::Machine)
      return; // that of the program goes before it
    ContractIssue issue{ContractIssueKind::Repeated,
                        reading_.result.clauses[id_].source,
                        reading_.result.clauses[id_].span,
                        std::move(what),
                        first,
                        contract_.program};
    contract_.isSound = false;
    addIssue(reading_, std::move(issue));
  }

  // ---- values on entry ----

  void entryValue(std::vector<EntryValue> &entries) {
    const bool isParam = &entries == &contract_.params;
    const ClauseReader::Variable variable = reader_.variable();
    EntryValue value{id_, variable.number, variable.span, {}, AnyNumber{}};
    if (!reader_.failed())
      refuseWrongKind(value, isParam);
    if (const auto name = reader_.peekName(); name && !reader_.at("IN") && !reader_.at("BY") && !reader_.at("OPTIONAL"))
      value.name = reading_.result.source(source()).utf8(reader_.name("a name"));
    value.values = readValues(value.name);
    readUnit(value);
    if (reader_.take("BY"))
      value.step = readStep(reader_, reading_);
    if (reader_.take("OPTIONAL"))
      value.vacancy = Vacancy::Possible;
    if (isRead())
      addOnce(entries, std::move(value));
  }
  void addOnce(std::vector<EntryValue> &entries, EntryValue value) {
    for (const std::vector<EntryValue> *list : {&contract_.params, &contract_.globals})
      if (const auto first = std::ranges::find(*list, value.variable, &EntryValue::variable); first != list->end())
        return refuseSecond(first->clause, fmt::format("`#{}`", value.variable));
    entries.push_back(std::move(value));
  }

  void refuseWrongKind(const EntryValue &value, bool isParam) {
    const VariableRange *range = findVariable(reading_.dialect, value.variable);
    const bool isLocal = range && range->kind == VariableKind::Local;
    if (!range || range->kind == VariableKind::Vacant)
      reader_.fail(ContractIssueKind::Malformed, value.variableSpan, "a variable that this control has");
    else if (isParam && !isLocal)
      reader_.fail(ContractIssueKind::Malformed, value.variableSpan,
                   "a local variable, which holds an argument; `@GLOBAL` is for other variables");
    else if (!isParam && isLocal)
      reader_.fail(ContractIssueKind::Malformed, value.variableSpan,
                   "a common variable; `@PARAM` is for arguments, in local variables");
  }

  AllowedValues readValues(std::string_view name) {
    if (reader_.take("IN"))
      return readList();
    if (reader_.atEnd() || reader_.peekName())
      return AnyNumber{};
    const std::string_view of = name.empty() ? "the variable" : name;
    return reader_.range(fmt::format("the range of {}, such as `0.5..50.`", of));
  }

  ValueList readList() {
    ValueList list;
    do
      list.values.push_back(reader_.value("a value behind `IN`"));
    while (!reader_.failed() && reader_.takeSign(','));
    return list;
  }

  void readUnit(EntryValue &value) {
    const std::optional<Span> word = reader_.peekName();
    if (!word || reader_.at("BY") || reader_.at("OPTIONAL") || reader_.failed())
      return;
    const std::string name = toUpper(reader_.text(*word));
    const auto found = std::ranges::find(kUnitNames, name);
    if (found == std::end(kUnitNames)) {
      const auto nearest = nearestWord(name, kUnitNames);
      return reader_.fail(ContractIssueKind::Unit, *word,
                          nearest && !nearest->empty()
                              ? fmt::format("there is no such unit; did you mean `{}`?", *nearest)
                              : fmt::format("there is no such unit; the units are `{}`",
                                            fmt::join(std::begin(kUnitNames) + 1, std::end(kUnitNames), " ")));
    }
    value.unit = static_cast<Unit>(found - std::begin(kUnitNames));
    value.unitSpan = reader_.name("a unit");
  }

  void require() {
    const ExpressionId condition = reader_.condition(nullptr);
    if (isRead())
      contract_.requirements.push_back({id_, condition});
  }

  // ---- modal state, position, tool ----

  void modal() {
    for (const ModalCode &code : readCodes()) {
      const auto first = std::ranges::find(contract_.modal, code.group, &ModalCode::group);
      if (first == contract_.modal.end()) {
        contract_.modal.push_back(code);
        continue;
      }
      const std::string_view other =
          reading_.result.source(reading_.result.clauses[first->clause].source).text(first->span);
      ContractIssue issue{ContractIssueKind::Code,
                          source(),
                          code.span,
                          fmt::format("`{}` is already there, and only one code of a group can be active", other),
                          first->clause,
                          contract_.program};
      contract_.isSound = false;
      addIssue(reading_, std::move(issue));
    }
  }

  /// None when the clause has an issue.
  std::vector<ModalCode> readCodes() {
    std::vector<ModalCode> codes;
    do {
      const Span span = reader_.ahead();
      const std::optional<char> letter = reader_.takeLetter("GM");
      if (!letter) {
        reader_.expected("a code such as `G90`");
        break;
      }
      const ExpressionId number = reader_.value("the number of the code");
      if (!reader_.failed())
        codes.push_back(codeFrom(*letter, number, span));
    } while (!reader_.failed() && !reader_.atEnd());
    return isRead() ? codes : std::vector<ModalCode>();
  }

  ModalCode codeFrom(char letter, ExpressionId number, Span span) {
    const std::optional<Decimal> value = literalValue(reading_.result.tree, number);
    const std::optional<std::uint16_t> tenths =
        value ? Word::number(letter, *value, span, 0).tenths() : std::optional<std::uint16_t>();
    const Code *code = !tenths         ? nullptr
                       : letter == 'G' ? findGCode(reading_.dialect, *tenths)
                                       : findMCode(reading_.dialect, *tenths);
    if (!code)
      reader_.fail(ContractIssueKind::Code, span, "this control has no such code");
    else if (code->group == 0)
      reader_.fail(ContractIssueKind::Code, span, "it acts only in its own block and is not modal");
    return {id_, letter, tenths.value_or(0), code ? code->group : std::uint8_t{0}, span};
  }

  void start() {
    std::vector<AxisValue> axes = readAxisValues(reader_, kAxes);
    if (axes.empty())
      reader_.expected("axes such as `X0 Y0 Z5.`");
    if (isRead())
      setOnce(contract_.start, StartPosition{id_, std::move(axes)}, "the position on entry");
  }

  void tool() {
    const ContractTool tool = readTool(reader_, reading_.dialect.machine, id_);
    if (isRead())
      setOnce(contract_.tool, tool, "the tool");
  }

  void offset() {
    if (reader_.at("EXT") || reader_.peekLetter("G"))
      return addValues(readWorkOffset(reader_, reading_));
    RadiusOffset offset{id_, {}, {}};
    if (!reader_.takeAddress('D'))
      reader_.expected("`D` and its number, such as `D1`, `D#20`, or `D*` for any");
    else if (!reader_.takeSign('*'))
      offset.number = reader_.value("the number of D, or `*` for any");
    if (!reader_.take("RADIUS"))
      reader_.expected("`RADIUS` and its value");
    offset.radius = reader_.valueOrRange("the radius, such as `5.` or `4.9..5.1`");
    if (!reader_.failed() && !offset.radius.low && !offset.radius.high)
      reader_.expected("an end of the range of the radius");
    const auto isOfEvery = [](const RadiusOffset &each) { return !each.number; };
    const auto first = std::ranges::find_if(contract_.offsets, isOfEvery);
    if (isRead() && !offset.number && first != contract_.offsets.end())
      return refuseSecond(first->clause, "the offset of every D");
    if (isRead())
      contract_.offsets.push_back(offset);
  }

  // ---- the set-up ----

  void length() {
    const LengthRange length = readLength(reader_, reading_, id_);
    if (!isRead())
      return;
    const auto first = std::ranges::find(contract_.lengths, length.number, &LengthRange::number);
    if (first != contract_.lengths.end())
      return refuseSecond(first->clause,
                          length.number ? fmt::format("the length of H{}", *length.number) : "the length of every H");
    contract_.lengths.push_back(length);
  }
  void machine() {
    refuseOnLathe("tool offsets of a lathe are not followed in machine coordinates");
    Box box = readBox(reader_, reading_.dialect.machine);
    std::vector<SetUpValue> home;
    if (reader_.take("HOME"))
      home = readHome(reader_, reading_);
    if (!isRead())
      return;
    setOnce(contract_.machine, MachineRange{id_, std::move(box)}, "the range of the machine");
    addValues(std::move(home));
  }
  void corner() {
    const std::optional<CornerRounding> corner = readCorner(reader_, reading_, id_);
    if (isRead())
      setOnce(contract_.corner, *corner, "the rounding of corners");
  }
  void fixed() {
    refuseOnLathe("on a lathe, regions lie all round the spindle already, and A and B are not followed");
    FixedAxes fixed = readFixed(reader_, id_);
    if (isRead())
      setOnce(contract_.fixed, std::move(fixed), "the axes at every angle of which the regions are the same");
  }
  void addValues(std::vector<SetUpValue> values) {
    if (!isRead())
      return;
    for (SetUpValue &value : values)
      addOnce(contract_.globals, {id_, value.variable, reading_.result.clauses[id_].span, {}, std::move(value.values)});
  }

  // ---- geometry ----

  void refuseOnLathe(std::string_view why) {
    if (reading_.dialect.machine == MachineKind::Turning)
      reader_.fail(ContractIssueKind::Code, reading_.result.clauses[id_].span, std::string(why));
  }

  void region(std::vector<Region> &regions) {
    const bool isShape = reader_.at("BOX") || reader_.at("CYLINDER") || reader_.at("SPHERE") || reader_.at("POLYGON") ||
                         reader_.at("WHERE");
    if (isShape)
      reader_.expected("a name for the region before its shape");
    const Span name = reader_.name("a name for the region");
    Region read{id_, reading_.result.source(source()).utf8(name), readShape(reader_, reading_.dialect.machine)};
    if (isRead())
      regions.push_back(std::move(read));
  }

  void clearance() {
    refuseOnLathe("a height of clearance belongs to machining centres; state a region with `@KEEPOUT`");
    const std::optional<char> axis = reader_.takeLetter("XYZ");
    if (!axis)
      reader_.expected("an axis with its height, such as `Z2.`");
    const ExpressionId height = reader_.value("the height");
    if (isRead())
      setOnce(contract_.clearance, Clearance{id_, {axis.value_or('Z'), height}}, "the clearance");
  }

  void travel() {
    Box box = readBox(reader_, reading_.dialect.machine);
    if (isRead())
      setOnce(contract_.travel, Travel{id_, std::move(box)}, "the travel");
  }

  void limit() {
    const std::optional<char> address = reader_.takeLetter("FS");
    if (!address)
      reader_.expected("`F` or `S` with its range, such as `F 1..5000`");
    const Range range = reader_.range("the range");
    if (!isRead())
      return;
    const auto first = std::ranges::find(contract_.limits, *address, &WordLimit::address);
    if (first != contract_.limits.end())
      return refuseSecond(first->clause, fmt::format("the limit of {}", *address));
    contract_.limits.push_back({id_, *address, range});
  }

  // ---- promises ----

  void ensure() {
    if (reader_.take("MODAL")) {
      if (!reader_.take("PRESERVED"))
        reader_.expected("`PRESERVED`");
      ModalPreserved kept;
      if (reader_.take("EXCEPT")) {
        while (const std::optional<char> address = reader_.takeLetter("FSTDHEBP"))
          kept.except += *address;
        if (kept.except.empty())
          reader_.expected("addresses, such as `EXCEPT F S`");
      }
      if (isRead())
        contract_.ensures.push_back({id_, std::move(kept)});
      return;
    }
    if (reader_.peekLetter("GM")) {
      if (std::vector<ModalCode> codes = readCodes(); !codes.empty())
        contract_.ensures.push_back({id_, std::move(codes)});
      return;
    }
    const ExpressionId condition = reader_.condition(findPromiseOperand);
    if (isRead())
      contract_.ensures.push_back({id_, condition});
  }

  void tolerance() {
    const Span span = reader_.ahead();
    constexpr std::string_view kExpected = "a positive number below 1, such as `0.01`";
    const ExpressionId number = reader_.value(kExpected);
    const auto most = reader_.failed() ? std::nullopt : literalValue(reading_.result.tree, number);
    if (!most || *most <= Decimal::fromInteger(0) || *most >= Decimal::fromInteger(1))
      reader_.fail(ContractIssueKind::Malformed, span, std::string(kExpected));
    if (isRead())
      setOnce(contract_.tolerance, EqualTolerance{id_, *most}, "the tolerance");
  }

  void assigns() {
    Assigns assigns{id_, {}};
    if (!reader_.take("NOTHING"))
      do {
        const std::uint32_t first = reader_.variable().number;
        const bool isRange = reader_.takeSign('.') && reader_.takeSign('.');
        const std::uint32_t last = isRange ? reader_.variable().number : first;
        if (last < first)
          reader_.fail(ContractIssueKind::EmptyRange, reading_.result.clauses[id_].span,
                       fmt::format("`#{}` comes after `#{}`", first, last));
        assigns.variables.push_back({first, last});
      } while (!reader_.failed() && !reader_.atEnd());
    if (isRead())
      contract_.assigns.push_back(std::move(assigns));
  }

  void eventually() {
    const ExpressionId condition = reader_.condition(nullptr);
    const auto awaited = reader_.failed() ? std::nullopt : awaitedIn(condition);
    if (!awaited && !reader_.failed())
      reader_.fail(ContractIssueKind::Malformed, reading_.result.tree.expressions[condition].span,
                   "an input that the machine changes, compared with a number, such as `#1000 EQ 1`");
    if (isRead())
      contract_.awaited.push_back(*awaited);
  }

  std::optional<AwaitedInput> awaitedIn(ExpressionId condition) const {
    const SyntaxTree &tree = reading_.result.tree;
    const auto *relation = std::get_if<BinaryOperation>(&tree.expressions[unwrapped(tree, condition)].node);
    if (!relation || !isRelation(relation->op))
      return std::nullopt;
    const auto variable = variableNumber(tree, unwrapped(tree, relation->left));
    const auto value = literalValue(tree, relation->right);
    const VariableRange *range = variable ? findVariable(reading_.dialect, *variable) : nullptr;
    if (!value || !range || !isVolatile(range->role))
      return std::nullopt;
    return AwaitedInput{id_, *variable, relation->op, *value};
  }

  void mark(std::optional<ClauseId> &place) {
    if (!isRead())
      return;
    if (place)
      return refuseSecond(*place, fmt::format("`{}`", nameOf(reading_.result.clauses[id_].kind)));
    place = id_;
  }

  void guarded() {
    Guarded guarded{id_};
    if (reader_.take("EXCEPT")) {
      for (bool more = true; more;) {
        const bool modal = reader_.take("MODAL"), start = !modal && reader_.take("START");
        guarded.exceptModal |= modal;
        guarded.exceptStart |= start;
        more = modal || start;
      }
      if (!guarded.exceptModal && !guarded.exceptStart)
        reader_.expected("`MODAL` or `START`");
    }
    if (isRead())
      setOnce(contract_.guarded, guarded, "`@GUARDED`");
  }

  void alarm() {
    const std::uint32_t number = reader_.integer("the number of an alarm");
    AlarmClaim claim = AlarmClaim::If;
    if (reader_.take("IFF"))
      claim = AlarmClaim::IfAndOnlyIf;
    else if (!reader_.take("IF"))
      reader_.expected("`IF` or `IFF` and a condition");
    const ExpressionId condition = reader_.condition(nullptr);
    if (isRead())
      contract_.alarms.push_back({id_, number, claim, condition});
  }

  // ---- loops ----

  void hint(std::vector<LoopHint> &hints) {
    const bool isInvariant = &hints == &contract_.invariants;
    const ExpressionId expression =
        isInvariant ? reader_.condition(findPromiseOperand) : reader_.expression(findPromiseOperand);
    if (!isRead())
      return;
    if (const std::optional<BlockId> block = loopHead(); block && !reader_.failed())
      hints.push_back({id_, *block, expression});
  }

  std::optional<BlockId> loopHead() {
    const std::optional<BlockId> block = raw_.source == kProgramText ? raw_.place : blockOfNumber();
    const Span span = raw_.number.value_or(reading_.result.clauses[id_].span);
    if (block && !reader_.failed() && isLoopHead(reading_, contract_.program, *block))
      return block;
    reader_.fail(ContractIssueKind::Place, span, "no loop begins there");
    return std::nullopt;
  }

  std::optional<BlockId> blockOfNumber() {
    const Span clause = reading_.result.clauses[id_].span;
    if (!raw_.number) {
      reader_.fail(ContractIssueKind::Place, clause,
                   "in a sidecar file it needs the sequence number of the loop: `@AT N30 ...`");
      return std::nullopt;
    }
    const std::string_view text = reading_.result.source(source()).text(*raw_.number);
    constexpr std::size_t kMostDigits = 9;
    const std::string_view digits = text.substr(std::min<std::size_t>(1, text.size()));
    if (toUpper(text.substr(0, 1)) != "N" || digits.empty() || digits.size() > kMostDigits ||
        !std::ranges::all_of(digits, isDigit)) {
      reader_.fail(ContractIssueKind::Malformed, *raw_.number, "a sequence number such as `N30`");
      return std::nullopt;
    }
    const auto number = static_cast<std::uint32_t>(std::stoul(std::string(digits)));
    const std::vector<SequenceNumber> found = reading_.model.find(contract_.program, number);
    if (found.size() == 1)
      return found.front().block;
    reader_.fail(ContractIssueKind::Place, *raw_.number,
                 found.empty() ? fmt::format("the program has no N{}", number)
                               : fmt::format("the program has N{} {} times", number, found.size()));
    return std::nullopt;
  }

  ContractSourceId source() const { return raw_.source; }

  ContractReading &reading_;
  const RawClause &raw_;
  ClauseId id_;
  ClauseReader reader_;
  Contract &contract_;
};

ClauseHead headOf(std::string_view text, const RawClause &raw) {
  std::uint32_t end = raw.span.begin;
  while (end < raw.span.end && (text[end] == '@' || text[end] == '-' || text[end] == '_' || isLetter(text[end])))
    ++end;
  const Span keyword{raw.span.begin, end};
  std::string name = toUpper(text.substr(keyword.begin, keyword.size()));
  if (raw.number && !name.starts_with('@'))
    name.insert(name.begin(), '@');
  return {keyword, std::move(name)};
}

/// The whole word where it is none of ours.
Span wordAt(std::string_view text, Span span) {
  std::uint32_t end = span.begin;
  while (end < span.end && !isBlank(text[end]))
    ++end;
  return {span.begin, end};
}

bool isSuppression(std::string_view name) { return name == "@ALLOW" || name == "@ALLOW-PROGRAM"; }

void refuseUnknown(ContractReading &reading, const RawClause &raw, const ClauseHead &head, std::string_view text) {
  std::vector<std::string_view> names(std::begin(kClauseNames), std::end(kClauseNames));
  names.insert(names.end(), {"@ALLOW", "@ALLOW-PROGRAM", "@AT"});
  const auto nearest = nearestWord(head.name, names);
  const Span word = wordAt(text, raw.span);
  if (!nearest && text.substr(word.begin, word.size()).find(':') != std::string_view::npos)
    return; // no clause has a colon in its name: a mark of another program, such as `@NCE-SIM:1`
  contractOf(reading, raw.program).isSound = false;
  addIssue(reading, {ContractIssueKind::UnknownClause, raw.source, word, std::string(nearest.value_or("")),
                     std::nullopt, raw.program});
}

void refuse(ContractReading &reading, const RawClause &raw, Span span, std::string expected) {
  contractOf(reading, raw.program).isSound = false;
  addIssue(reading, {ContractIssueKind::Malformed, raw.source, span, std::move(expected), std::nullopt, raw.program});
}

} // namespace

void dropRemarks(const ContractReading &reading, std::vector<RawClause> &clauses) {
  std::vector<std::string_view> names(std::begin(kClauseNames), std::end(kClauseNames));
  names.insert(names.end(), {"@ALLOW", "@ALLOW-PROGRAM"});
  std::vector<ProgramId> withContract;
  for (const RawClause &raw : clauses) {
    const std::string name = headOf(reading.result.source(raw.source).text(), raw).name;
    if (raw.source != kProgramText || name == "@AT" || (!isSuppression(name) && nearestWord(name, names)))
      withContract.push_back(raw.program);
  }
  std::ranges::sort(withContract);
  std::erase_if(clauses, [&](const RawClause &raw) { return !std::ranges::binary_search(withContract, raw.program); });
}

void readClause(ContractReading &reading, const RawClause &raw) {
  const SourceFile source = reading.result.source(raw.source);
  const ClauseHead head = headOf(source.text(), raw);
  if (isSuppression(head.name) && raw.number)
    return refuse(reading, raw, *raw.number,
                  fmt::format("no `@AT`; the place comes after the rule: `{} rule N30 reason`", head.name));
  if (isSuppression(head.name) && raw.source != kProgramText)
    reading.result.allowances.push_back({raw.source, raw.span, raw.program});
  if (isSuppression(head.name))
    return; // read by those who suppress
  if (head.name == "@AT")
    return refuse(reading, raw, head.keyword, "a clause without `@AT`, since a comment already has a place");
  if (raw.number && raw.span.empty())
    return refuse(reading, raw, raw.span, "a clause after the place");
  const auto found = std::ranges::find(kClauseNames, head.name);
  if (found == std::end(kClauseNames))
    return refuseUnknown(reading, raw, head, source.text());
  const auto kind = static_cast<ClauseKind>(found - std::begin(kClauseNames));
  const ClauseId id = reading.result.clauses.add({kind, raw.source, raw.span, source.utf8(raw.span), raw.program});
  if (raw.number && kind != ClauseKind::Invariant && kind != ClauseKind::Variant) {
    return refuse(reading, raw, *raw.number,
                  fmt::format("no `@AT`, since `{}` applies to the whole program", head.name));
  }
  if (raw.scope == SidecarScope::Machine && !isOfSetUp(kind))
    return refuse(reading, raw, head.keyword,
                  "`@OFFSET`, `@LENGTH`, `@MACHINE` or `@CORNER`; others belong to a program");
  ReadClause(reading, raw, id, {head.keyword.end, raw.span.end}).run();
}

} // namespace feedhold
