// Calls: what a call passes, and what a modal call remembers.
#pragma once

#include "meaning/cfg/computed_repeats.h"
#include "meaning/semantics/executed_words.h"

namespace feedhold {

/// What an engine has to do at a call node.
enum class CallAction : std::uint8_t {
  Enter,     // run the program, then go on behind the call
  SetModal,  // G66: done, nothing is called now
  EndModal,  // G67: done
  Operation, // G65 H..: an operation of Macro A, not followed
};

template <typename R> struct CallRequest {
  CallAction action = CallAction::Enter;
  std::optional<Callee> callee;                 // absent: in none of the files, or its number is not one constant
  std::vector<Callee> possible;                 // without `callee`: what a computed number may name in these files
  std::optional<typename R::Value> number = {}; // of `possible`, each of which begins at its first block
  bool isLocal = false;                         // M97: a part of the calling program, found by its sequence number
  bool freshLocals = false;                     // a level of its own (G65); false: the caller's (M98)
  std::array<typename R::Value, kLocalVariables + 1> locals;
  typename R::Value repeats; // L
};

/// Reads the arguments.  SetModal and EndModal have been carried out when this returns.
template <ValueAlgebra R> CallRequest<R> prepareCall(StepContext<R> &context, CallId call);

/// The call of a modal macro after a movement: its locals are those of the level kept by G66.
template <ValueAlgebra R>
CallRequest<R> prepareModalCall(StepContext<R> &context, const ModalCallState<typename R::Value> &modal);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> class CallReader {
public:
  using Value = typename R::Value;

  CallReader(StepContext<R> &context, CallId id)
      : context_(context), interpretation_(context.interpretation), id_(id), call_(context.file.model->calls[id]) {}

  CallRequest<R> read() {
    CallRequest<R> request;
    request.repeats = interpretation_.number(1);
    request.isLocal = call_.kind == CallKind::Local;
    switch (call_.kind) {
    case CallKind::ModalCancel: return endModal(std::move(request));
    case CallKind::MacroA: request.action = CallAction::Operation; return request;
    case CallKind::Modal:
    case CallKind::ModalEach:
      request.action = CallAction::SetModal;
      requireRoom();
      passArguments(request);
      readRepeats(request);
      context_.state.modalCalls.push_back({context_.file.file.index(), id_.index(), request.repeats, request.locals});
      return request;
    case CallKind::Macro:
    case CallKind::OWord: passArguments(request); break;
    case CallKind::Code: passCode(request); break;
    case CallKind::Subprogram:
    case CallKind::Local:
    case CallKind::External: break;
    }
    request.callee = callee(request);
    readRepeats(request);
    return request;
  }

private:
  /// Modal calls nest as deep as other macro calls do.
  void requireRoom() {
    const auto unknown = context_.state.modalCallsUnknown;
    const bool isFull = context_.state.modalCalls.size() >= context_.dialect().limits.macroCallDepth;
    interpretation_.alarm(isFull ? interpretation_.negation(unknown)
                                 : interpretation_.both(unknown, interpretation_.unknownTruth()),
                          {AlarmKind::MacroNesting, context_.place()});
  }
  CallRequest<R> endModal(CallRequest<R> request) {
    request.action = CallAction::EndModal;
    if (const auto none = noModalCall(); interpretation_.mayBe(none)) {
      const auto isIgnored = context_.isOn(&Switches::g67);
      interpretation_.alarm(interpretation_.both(none, interpretation_.negation(isIgnored)),
                            {AlarmKind::NoModalCall, context_.place()});
    }
    if (!context_.state.modalCalls.empty())
      context_.state.modalCalls.pop_back();
    return request;
  }
  /// What is not followed may also have ended the modal calls that were known.
  typename R::Truth noModalCall() {
    const auto unknown = context_.state.modalCallsUnknown;
    if (!context_.state.modalCalls.empty())
      return interpretation_.mayBe(unknown) ? interpretation_.both(unknown, interpretation_.unknownTruth()) : unknown;
    return context_.either(interpretation_.negation(unknown), context_.maybeNot());
  }

  void passArguments(CallRequest<R> &request) {
    request.freshLocals = true;
    request.locals.fill(interpretation_.vacant());
    for (const Argument &argument : call_.arguments)
      if (argument.role == ArgumentRole::Passed && argument.variable != 0)
        request.locals[argument.variable] = argumentValue(context_.tree().words[argument.word]);
      else if (argument.role == ArgumentRole::Forbidden)
        refuse(AlarmKind::ArgumentAddress, argument);
      else if (argument.role == ArgumentRole::BeyondSets)
        refuse(AlarmKind::TooManyIjkSets, argument);
    for (std::size_t i = 0; i < call_.values.size() && i + 1 < request.locals.size(); ++i)
      request.locals[i + 1] = evaluate(context_, call_.values[i]);
  }
  /// Most controls stop; G66.1 of some may pass a G.  Where one goes on, what it makes of the word is not known.
  void refuse(AlarmKind alarm, const Argument &argument) {
    const Span place = context_.tree().words[argument.word].span();
    if (call_.kind != CallKind::ModalEach)
      interpretation_.alarm(interpretation_.unknownTruth(), {alarm, place});
    interpretation_.havoc(context_.state, "a word in a call that cannot be an argument", place);
  }
  /// Copied as it is: an argument that is dropped leaves its variable vacant, nothing is rounded to an increment.
  Value argumentValue(const Word &word) {
    if (word.form() == WordForm::Expression) {
      const Value value = evaluate(context_, word.expression());
      const auto present = isWordPresent(context_, word.expression(), value);
      return interpretation_.mayBe(interpretation_.negation(present))
                 ? interpretation_.select(present, value, interpretation_.vacant())
                 : value;
    }
    if (word.form() == WordForm::Number)
      return literalArgument(word);
    return interpretation_.anything();
  }
  Value literalArgument(const Word &word) {
    Value value = scaledLiteral(context_, word.address(), word.number(), word.has(Word::kPoint), PointRule::OfArgument);
    interpretation_.hold(value, {word.span(), NumberLiteral{word.number()}});
    return value;
  }
  /// G and M codes of the machine's tables; T is handed over in #149.
  void passCode(CallRequest<R> &request) {
    const Word &code = context_.tree().words[call_.code];
    const auto tenths = code.tenths();
    const CodeCall *row = tenths ? findCodeCall(context_.dialect(), code.address(), *tenths) : nullptr;
    if (code.address() == 'T' && code.isNumber())
      context_.state.variables.set(kToolCallVariable, interpretation_.literal(code.number()));
    if (row && row->isMacro)
      passArguments(request);
  }
  static constexpr std::uint32_t kToolCallVariable = 149;

  std::optional<Callee> callee(CallRequest<R> &request) {
    std::vector<Callee> &possible = request.possible;
    if (const auto known = context_.programs.callee(context_.file.file, id_))
      return known;
    if (!call_.callee.empty())
      possible = context_.programs.candidates(context_.file.file, call_);
    if (!call_.programWord || !call_.callee.empty() || call_.kind == CallKind::External)
      return std::nullopt;
    const Word &word = context_.tree().words[*call_.programWord];
    if (word.form() != WordForm::Expression)
      return std::nullopt;
    const Value value =
        interpretation_.roundTo(interpretation_.asNumber(evaluate(context_, word.expression())), Decimal(1, 0));
    if (call_.kind == CallKind::Local)
      return localCallee(value, possible);
    const std::optional<double> number = interpretation_.constantOf(value);
    const bool isStartKnown = !context_.programs.startsInside(context_.file.file, call_);
    if (!number || !isStartKnown)
      possible = calleesOf(value);
    if (!number && isStartKnown)
      request.number = value;
    if (!number || !isStartKnown || *number < 0 || *number > 1e9)
      return std::nullopt;
    const auto found = context_.programs.calleeOf(context_.file.file, static_cast<std::uint32_t>(*number));
    if (!found)
      possible = context_.programs.candidates(context_.file.file, call_, static_cast<std::uint32_t>(*number));
    return found;
  }
  std::optional<Callee> localCallee(const Value &value, std::vector<Callee> &possible) {
    const std::vector<Callee> parts = partsOf(value);
    if (interpretation_.constantOf(value))
      return parts.empty() ? std::nullopt : std::optional(parts.front());
    possible = parts;
    return std::nullopt;
  }
  std::vector<Callee> partsOf(const Value &value) {
    std::vector<Callee> parts;
    for (const LabelledPart &part : context_.programs.localParts(context_.file.file, call_))
      if (interpretation_.mayBe(interpretation_.compare(Relation::Equal, value, interpretation_.number(part.number))))
        parts.push_back(part.callee);
    return parts;
  }
  std::vector<Callee> calleesOf(const Value &value) {
    return context_.programs.numbered(context_.file.file, call_, [&](std::uint32_t number) {
      return interpretation_.mayBe(interpretation_.compare(Relation::Equal, value, interpretation_.number(number)));
    });
  }
  void readRepeats(CallRequest<R> &request) {
    if (call_.repeats) {
      request.repeats = interpretation_.number(*call_.repeats);
      return;
    }
    if (context_.programs.callGraph().isPacked(context_.file.file, call_))
      request.repeats = interpretation_.number(call_.packed->repeats);
    if (call_.kind == CallKind::OWord)
      return; // has no words
    if (computedRepeats(context_.tree(), call_)) {
      request.repeats = interpretation_.number(1);
      return;
    }
    const Span code = context_.tree().words[call_.code].span();
    for (const Word &word : context_.tree().wordsOf(context_.block))
      if (word.address() == 'L' && word.form() == WordForm::Expression && word.span().begin > code.begin)
        request.repeats = repeatsOf(evaluate(context_, word.expression()));
  }
  /// A vacant word counts as not written.
  Value repeatsOf(const Value &value) {
    return interpretation_.select(interpretation_.isVacant(value), interpretation_.number(1),
                                  interpretation_.roundTo(interpretation_.asNumber(value), Decimal(1, 0)));
  }

  StepContext<R> &context_;
  R &interpretation_;
  CallId id_;
  const Call &call_;
};

} // namespace detail

template <ValueAlgebra R> CallRequest<R> prepareCall(StepContext<R> &context, CallId call) {
  return detail::CallReader<R>(context, call).read();
}

template <ValueAlgebra R>
CallRequest<R> prepareModalCall(StepContext<R> &context, const ModalCallState<typename R::Value> &modal) {
  CallRequest<R> request;
  request.freshLocals = true;
  request.locals = modal.locals;
  request.repeats = modal.repeats;
  request.callee = context.programs.callee(FileId(modal.file), CallId(modal.call));
  const ProgramFile &file = context.programs.file(FileId(modal.file));
  const Call &call = file.model->calls[CallId(modal.call)];
  if (!request.callee)
    request.possible = context.programs.candidates(file.file, call);
  // Which number G66 computed is not kept: it may be that of each program.
  if (call.programWord && call.callee.empty() && file.tree->words[*call.programWord].form() == WordForm::Expression)
    request.possible = context.programs.numbered(file.file, call, [](std::uint32_t) { return true; });
  return request;
}

} // namespace feedhold
