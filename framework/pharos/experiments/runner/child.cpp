#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/experiments/runner/child.h>

namespace pharos {
namespace {

constexpr int kNotStarted = 127;

/// Blocks all signals of the thread while it exists.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~HeldSignals() { release(); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  void release() const { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

/// Gives all signals that have a handler their default action.
void forget_handlers() {
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action;
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    std::signal(signal, SIG_DFL);
  }
}

/// Replaces the forked process by the program. Only calls functions that are safe after fork() in a
/// process with threads. No signal handler of the parent may run here, because the signal would
/// then be lost, or the handler could wait forever for a lock that another thread held.
[[noreturn]] void become(char* const* arguments, rlim_t bytes, pid_t parent,
                         const HeldSignals& held) {
  forget_handlers();
  held.release();
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with its parent
  if (getppid() != parent) _exit(kNotStarted);
  const rlimit space{bytes, bytes};
  if (bytes != RLIM_INFINITY) setrlimit(RLIMIT_AS, &space);
  execv(arguments[0], arguments);
  _exit(kNotStarted);
}

pid_t start(const std::vector<std::string>& command, const ChildLimits& limits) {
  std::vector<char*> arguments;
  for (const std::string& each : command) arguments.push_back(const_cast<char*>(each.c_str()));
  arguments.push_back(nullptr);
  const rlim_t bytes = limits.bytes ? static_cast<rlim_t>(*limits.bytes) : RLIM_INFINITY;
  const HeldSignals held;
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become(arguments.data(), bytes, parent, held);
  if (child < 0) throw RunError(fmt::format("no process can be started: {}", std::strerror(errno)));
  return child;
}

/// Returns what is wrong with the end of a program; empty: nothing.
std::string problem_of(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  }
  const int code = WEXITSTATUS(status);
  return code == 0 ? "" : fmt::format("ended with exit code {}", code);
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& command, const ChildLimits& limits,
                   const std::atomic<bool>* stop) {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  const Clock::time_point begin = Clock::now();
  const pid_t child = start(command, limits);
  bool is_asked = false;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (limits.seconds && seconds > *limits.seconds) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return {.is_stopped = false,
              .problem = fmt::format("took longer than {:g} s", *limits.seconds)};
    }
    if (stop != nullptr && *stop && !is_asked) {
      kill(child, SIGTERM);
      is_asked = true;
    }
    std::this_thread::sleep_for(milliseconds(seconds < 0.1 ? 1 : 20));
  }
  const std::string problem = problem_of(status);
  // Ctrl-C in a terminal goes to the child, too, so that the child may end before it is asked.
  if (!problem.empty() && stop != nullptr && *stop) return {.is_stopped = true, .problem = {}};
  return {.is_stopped = false, .problem = problem};
}

}  // namespace pharos
