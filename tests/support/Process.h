#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace tessera::test {

struct ProcessOptions {
    std::filesystem::path folder;                   ///< working directory; empty: that of this process
    std::map<std::string, std::string> environment; ///< replaces or adds to this process's variables
    double timeoutSeconds = 180.0;                  ///< beyond it the program is killed and std::runtime_error thrown
};

struct ProcessResult {
    std::optional<int> exitCode; ///< none when a signal ended the program
    int signal = 0;              ///< that signal
    std::string out, err;        ///< all of stdout and stderr
};

/// A running program with an empty stdin, its stdout and stderr captured. The first word of the command is looked up in
/// PATH. Throws std::runtime_error if a system call fails; a program that cannot be started exits with code 127.
class Process {
public:
    explicit Process(const std::vector<std::string>& command, ProcessOptions options = {});
    ~Process(); ///< kills a process that is still running
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) const;
    /// Waits for the end; call it once.
    ProcessResult wait();

private:
    ProcessOptions options_;
    pid_t pid_ = -1;
    int outPipe_ = -1, errPipe_ = -1;
};

inline ProcessResult runProcess(const std::vector<std::string>& command, ProcessOptions options = {}) {
    return Process(command, std::move(options)).wait();
}

} // namespace tessera::test
