// Programs in processes of their own: how they end.

#include <atomic>
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include <pharos/experiments/runner/child.h>

namespace pharos {
namespace {

ChildEnd shell(const std::string& script, const ChildLimits& limits = {},
               const std::atomic<bool>* stop = nullptr) {
  return run_child({"/bin/sh", "-c", script}, limits, stop);
}

TEST_CASE("children: done, failed, interrupted, killed, not there") {
  CHECK(shell("true").problem.empty());
  CHECK_FALSE(shell("true").is_stopped);
  CHECK(shell("exit 3").problem == "ended with exit code 3");
  // Interrupted by someone else.
  CHECK(shell("exit 130").problem == "ended with exit code 130");
  CHECK_FALSE(shell("exit 130").is_stopped);
  CHECK(shell("kill -SEGV $$").problem == "ended by signal 11 (Segmentation fault)");
  CHECK(run_child({"/nowhere/program"}, {}, nullptr).problem == "ended with exit code 127");
}

TEST_CASE("children: limits of time and memory") {
  CHECK(shell("exec sleep 20", {.seconds = 0.2, .bytes = {}}).problem == "took longer than 0.2 s");
  CHECK_FALSE(shell("true", {.seconds = {}, .bytes = 1e4}).problem.empty());
}

TEST_CASE("children: asked to end") {
  std::atomic<bool> stop{false};
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop = true;
  });
  const ChildEnd end = shell("trap 'exit 130' TERM; while true; do sleep 0.05; done", {}, &stop);
  later.join();
  CHECK(end.is_stopped);
  CHECK(end.problem.empty());
  CHECK(shell("exec sleep 20", {}, &stop).is_stopped);  // it ends at once, by the signal
}

}  // namespace
}  // namespace pharos
