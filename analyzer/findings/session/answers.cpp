#include "findings/session/answers.h"

namespace feedhold {

void Answers::add(const std::string &key, std::string record) {
  const std::lock_guard lock(mutex_);
  records_.insert_or_assign(key, std::move(record));
}

const std::string *Answers::find(const std::string &key) const {
  const std::lock_guard lock(mutex_);
  const auto found = records_.find(key);
  return found == records_.end() ? nullptr : &found->second;
}

} // namespace feedhold
