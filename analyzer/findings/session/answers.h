// Answers: what a run found out, each under a key that names all that it depends on.  The shards of a run keep theirs
// in parts, and the run that joins them takes its answers from there.
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace feedhold {

/// May be used from several threads.
class Answers {
public:
  void add(const std::string &key, std::string record);
  /// Null: there is none.  Stays valid.
  const std::string *find(const std::string &key) const;
  /// No thread may add any more.
  const std::map<std::string, std::string> &all() const { return records_; }

private:
  mutable std::mutex mutex_;
  std::map<std::string, std::string> records_;
};

/// What a run does with answers.
struct AnswerUse {
  Answers *kept = nullptr; // its own are added; null: nobody asks for them
  const Answers *given =
      nullptr; // taken instead of working anything out, and what is not there is an error; null: none
};

inline constexpr const char *kNoAnswer =
    "no part has the results of this file: it, its settings or its folder have changed since";

} // namespace feedhold
