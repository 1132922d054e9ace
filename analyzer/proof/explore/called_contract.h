// CalledContract: what the contract of a called program says in the place of its text, where it is not followed.
#pragma once

#include "language/contract/contract.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace feedhold::prove {

class CalledContract {
public:
  virtual ~CalledContract() = default;

  virtual const std::string &name() const = 0;
  virtual const FileContracts &file() const = 0;
  virtual const Contract &contract() const = 0;
  /// What the state in which the program is entered has to satisfy: then it keeps its promises, for all numbers.
  virtual std::vector<smt::TermId> demands(const SymbolicState &entered) = 0;
  /// `now`, in which anything may have changed since `before`: the parts that the contract says to be kept are as they
  /// were, and the codes in force that it names.
  virtual void keep(const SymbolicState &before, SymbolicState &now) = 0;
  /// What holds where the program returns, of its own variables.
  virtual std::vector<smt::TermId> promises(const SymbolicState &entered, const SymbolicState &returned) = 0;
  /// The variables that the program may write, beside its locals; absent: any, or too many to be told one by one.
  virtual std::optional<std::vector<std::uint32_t>> written() const = 0;
};

/// Of the program that a call enters, or would enter if it were in the files.  Null: nothing is promised.
using CallContracts =
    std::function<std::shared_ptr<CalledContract>(FileId from, const Call &call, const std::optional<Callee> &callee)>;

/// Whose promises paths take in the place of a text.  A program whose text is there is followed where another
/// exploration does not rely on its contract.
enum class Reliance : std::uint8_t { Nobody, Missing, Called };

} // namespace feedhold::prove
