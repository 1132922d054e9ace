// Lane: newer work on a document stops older one, whoever does it.
#include "surface/lsp/lane.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

namespace feedhold::lsp {
namespace {

TEST(Lane, AThreadWorksInOrder) {
  std::promise<std::string> done;
  std::string said;
  Lane lane(Worker::Thread);
  lane.submit("a", [&](const std::stop_token &) { said += "a"; });
  lane.submit("b", [&](const std::stop_token &) { done.set_value(said + "b"); });
  EXPECT_EQ(done.get_future().get(), "ab");
  EXPECT_FALSE(lane.isReady());
}

TEST(Lane, TheEndStopsWhatRunsInAThread) {
  std::promise<void> begun;
  {
    Lane lane(Worker::Thread);
    lane.submit("a", [&](const std::stop_token &stop) {
      begun.set_value();
      while (!stop.stop_requested())
        std::this_thread::yield();
    });
    begun.get_future().wait();
  }
}

TEST(Lane, AnOwnerWorksWhenItWants) {
  std::vector<std::string> said;
  Lane lane(Worker::Owner);
  const auto job = [&](std::string name) {
    return [&said, name](const std::stop_token &stop) {
      said.push_back(name + (stop.stop_requested() ? " stopped" : ""));
    };
  };
  EXPECT_FALSE(lane.workNext());
  lane.submit("a", job("a1"));
  lane.submit("b", job("b"));
  lane.submit("a", job("a2"));
  EXPECT_TRUE(said.empty());
  EXPECT_TRUE(lane.isReady());
  while (lane.workNext()) {
  }
  EXPECT_EQ(said, (std::vector<std::string>{"a1 stopped", "b", "a2"}));
}

TEST(Lane, AnOwnerStopsWorkFromWithin) {
  Lane lane(Worker::Owner);
  bool isStopped = false;
  lane.submit("a", [&](const std::stop_token &stop) {
    EXPECT_TRUE(lane.isWorking());
    lane.submit("b", [](const std::stop_token &) {});
    EXPECT_FALSE(lane.workNext()) << "one work at a time";
    lane.drop("a");
    isStopped = stop.stop_requested();
  });
  EXPECT_TRUE(lane.workNext());
  EXPECT_TRUE(isStopped);
  EXPECT_TRUE(lane.isReady());
  lane.end();
  EXPECT_FALSE(lane.workNext());
}

} // namespace
} // namespace feedhold::lsp
