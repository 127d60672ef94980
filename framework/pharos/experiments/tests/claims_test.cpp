// Work belongs to one living process at a time.

#include <csignal>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/experiments/runner/claims.h>
#include <pharos/tests/fixtures.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

/// Writes the claim of a process on a machine that is not this one.
void write_foreign_claim(const fs::path& file) {
  std::ofstream(file) << R"({"host": "far", "machine": "far away", "process": 1, "started": "2",
                             "since": 3})";
}

TEST_CASE("claims: one board has the work until it gives it back") {
  const test::TemporaryFolder folder;
  ClaimBoard one(folder / "claims"), other(folder / "claims");
  CHECK_FALSE(other.holder("run"));
  std::optional<Claim> claim = one.try_claim("run");
  REQUIRE(claim);
  CHECK_FALSE(other.try_claim("run"));
  CHECK_FALSE(one.try_claim("run"));
  REQUIRE(other.holder("run"));
  CHECK(other.holder("run")->process == getpid());
  CHECK(other.holder("run")->host == Claimant::self().host);
  CHECK(other.try_claim("run.2"));  // another name, which begins alike
  claim.reset();
  CHECK_FALSE(other.holder("run"));
  CHECK(other.try_claim("run"));
  CHECK(fs::is_empty(folder / "claims"));
}

TEST_CASE("claims: a moved claim is given back once") {
  const test::TemporaryFolder folder;
  ClaimBoard board(folder.path());
  std::optional<Claim> kept;
  {
    std::optional<Claim> claim = board.try_claim("run");
    kept.emplace(std::move(*claim));
  }
  CHECK(board.holder("run"));
  kept.reset();
  CHECK_FALSE(board.holder("run"));
}

TEST_CASE("claims: of many boards, one gets the work") {
  const test::TemporaryFolder folder;
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> owners{0};
    std::vector<std::thread> threads;
    std::vector<std::unique_ptr<ClaimBoard>> boards;
    std::vector<std::optional<Claim>> claims(4);
    for (int i = 0; i < 4; ++i) boards.push_back(std::make_unique<ClaimBoard>(folder.path()));
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&, i] {
        claims[i] = boards[i]->try_claim("run");
        owners += claims[i] ? 1 : 0;
      });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(owners == 1);
  }
}

TEST_CASE("claims: what a killed process of this machine had is free at once") {
  const test::TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    ClaimBoard board(folder.path());
    const auto claim = board.try_claim("run");
    folder.write("ready", "");
    pause();
  }
  while (!fs::exists(folder / "ready")) std::this_thread::sleep_for(milliseconds(5));
  ClaimBoard board(folder.path());
  REQUIRE(board.holder("run"));
  CHECK(board.holder("run")->process == child);
  CHECK_FALSE(board.try_claim("run"));
  kill(child, SIGKILL);
  // Dead, although its parent has not asked for it yet.
  siginfo_t info;
  waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  CHECK_FALSE(board.holder("run"));
  waitpid(child, nullptr, 0);
  CHECK_FALSE(board.holder("run"));
  {
    const std::optional<Claim> claim = board.try_claim("run");
    REQUIRE(claim);
    CHECK(fs::exists(folder / "run.2"));
    CHECK(board.holder("run")->process == getpid());
  }
  CHECK_FALSE(fs::exists(folder / "run.1"));
  CHECK_FALSE(fs::exists(folder / "run.2"));
}

TEST_CASE("claims: another machine's claim is free after its patience, and not before") {
  const test::TemporaryFolder folder;
  ClaimBoard board(folder.path(), {.beat = milliseconds(50), .patience = milliseconds(400)});
  write_foreign_claim(folder / "run.1");
  CHECK(board.holder("run")->host == "far");
  CHECK_FALSE(board.try_claim("run"));
  std::this_thread::sleep_for(milliseconds(600));
  CHECK_FALSE(board.holder("run"));
  CHECK(board.try_claim("run"));
}

TEST_CASE("claims: a claim file that was cut off counts as the claim of an unknown machine") {
  const test::TemporaryFolder folder;
  ClaimBoard board(folder.path(), {.beat = milliseconds(50), .patience = milliseconds(400)});
  folder.write("run.1", "");
  CHECK_FALSE(board.try_claim("run"));
  std::this_thread::sleep_for(milliseconds(600));
  CHECK(board.try_claim("run"));
}

TEST_CASE("claims: a process withdraws if another one has a claim with an earlier number") {
  const test::TemporaryFolder folder;
  ClaimBoard board(folder.path(), {.beat = milliseconds(50), .patience = milliseconds(400)});
  // As if the owner of number 2 had died and number 1 were taken anew meanwhile.
  write_foreign_claim(folder / "run.2");
  std::this_thread::sleep_for(milliseconds(600));
  write_foreign_claim(folder / "run.1");
  CHECK_FALSE(board.try_claim("run"));
  CHECK_FALSE(fs::exists(folder / "run.3"));
}

TEST_CASE("claims: looking leaves no trace") {
  const test::TemporaryFolder folder;
  const ClaimBoard board(folder / "claims");
  CHECK_FALSE(board.holder("run"));
  CHECK(board.names("").empty());
  CHECK_FALSE(fs::exists(folder / "claims"));
}

TEST_CASE("claims: the owner touches its claim, also while nothing else happens") {
  const test::TemporaryFolder folder;
  ClaimBoard board(folder.path(), {.beat = milliseconds(20), .patience = milliseconds(400)});
  const std::optional<Claim> claim = board.try_claim("run");
  const auto before = fs::last_write_time(folder / "run.1");
  std::this_thread::sleep_for(milliseconds(200));
  CHECK(fs::last_write_time(folder / "run.1") > before);
}

TEST_CASE("claims: an owner that was taken for dead does not touch what came after") {
  const test::TemporaryFolder folder;
  ClaimBoard board(folder.path());
  std::optional<Claim> claim = board.try_claim("run");
  write_foreign_claim(folder / "run.2");
  claim.reset();
  CHECK_FALSE(fs::exists(folder / "run.1"));
  CHECK(board.holder("run")->host == "far");
}

TEST_CASE("claims: names of claimed work") {
  const test::TemporaryFolder folder;
  ClaimBoard board(folder.path());
  const auto a = board.try_claim("worker@a"), b = board.try_claim("worker@b"),
             c = board.try_claim("run");
  CHECK(board.names("worker@") == std::vector<std::string>{"worker@a", "worker@b"});
}

}  // namespace
}  // namespace pharos
