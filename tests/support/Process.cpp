#include "tests/support/Process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::test {
namespace {

constexpr int kCannotStart = 127; // as in shells

[[noreturn]] void fail(const std::string& call) {
    throw std::runtime_error(call + " failed: " + std::strerror(errno));
}

struct Pipe {
    int read = -1, write = -1;
};

Pipe makePipe() {
    int ends[2];
    // Closed on exec, so that programs started at the same time do not hold each other's pipes open.
    if (::pipe2(ends, O_CLOEXEC) != 0) fail("pipe2");
    return {ends[0], ends[1]};
}

/// In the child; calls only functions that are safe between fork and exec.
[[noreturn]] void becomeProgram(char* const* words, const char* folder, char* const* environment, int out, int err) {
    const int empty = ::open("/dev/null", O_RDONLY);
    ::dup2(empty, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (*folder == '\0' || ::chdir(folder) == 0) ::execvpe(words[0], words, environment);
    constexpr char kText[] = "the program cannot be started\n";
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kText, sizeof(kText) - 1);
    ::_exit(kCannotStart);
}

std::vector<std::string> environmentWith(const std::map<std::string, std::string>& changes) {
    std::vector<std::string> all;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string text = *entry;
        if (!changes.contains(text.substr(0, text.find('=')))) all.push_back(text);
    }
    for (const auto& [name, value] : changes) all.push_back(name + "=" + value);
    return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> list;
    for (std::string& text : texts) list.push_back(text.data());
    list.push_back(nullptr);
    return list;
}

/// Appends what can be read; false at the end of the stream.
bool drain(int pipe, std::string& text) {
    std::array<char, 4096> part;
    const ssize_t count = ::read(pipe, part.data(), part.size());
    if (count < 0 && errno == EINTR) return true;
    if (count > 0) text.append(part.data(), std::size_t(count));
    return count > 0;
}

} // namespace

Process::Process(const std::vector<std::string>& command, ProcessOptions options) : options_(std::move(options)) {
    std::vector<std::string> words = command;
    std::vector<std::string> environment = environmentWith(options_.environment);
    const std::vector<char*> wordList = pointers(words), environmentList = pointers(environment);
    const Pipe out = makePipe(), err = makePipe();
    pid_ = ::fork();
    if (pid_ < 0) fail("fork");
    if (pid_ == 0)
        becomeProgram(wordList.data(), options_.folder.c_str(), environmentList.data(), out.write, err.write);
    ::close(out.write);
    ::close(err.write);
    outPipe_ = out.read;
    errPipe_ = err.read;
}

Process::~Process() {
    if (outPipe_ >= 0) ::close(outPipe_);
    if (errPipe_ >= 0) ::close(errPipe_);
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
}

void Process::send(int signal) const {
    if (pid_ > 0 && ::kill(pid_, signal) != 0) fail("kill");
}

ProcessResult Process::wait() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                     std::chrono::duration<double>(options_.timeoutSeconds));
    ProcessResult result;
    std::array<pollfd, 2> streams{pollfd{outPipe_, POLLIN, 0}, pollfd{errPipe_, POLLIN, 0}};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left <= 0) throw std::runtime_error("the program ran too long; until then it said: " + result.err);
        if (::poll(streams.data(), streams.size(), int(left)) < 0 && errno != EINTR) fail("poll");
        // poll() ignores negative descriptors.
        if (streams[0].revents != 0 && !drain(outPipe_, result.out)) streams[0].fd = -1;
        if (streams[1].revents != 0 && !drain(errPipe_, result.err)) streams[1].fd = -1;
    }
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0)
        if (errno != EINTR) fail("waitpid");
    pid_ = -1;
    if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    return result;
}

} // namespace tessera::test
