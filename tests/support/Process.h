#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace tessera::test {

struct ProcessOptions {
    std::filesystem::path folder;                   ///< working directory; empty: this process's own
    std::map<std::string, std::string> environment; ///< set on top of this process's own
    double timeoutSeconds = 180.0;                  ///< beyond it the program is killed and std::runtime_error thrown
};

struct ProcessResult {
    std::optional<int> exitCode; ///< none when a signal ended the program
    int signal = 0;              ///< that signal
    std::string out, err;        ///< all of stdout and stderr
};

/// A running program with an empty stdin, its stdout and stderr captured. The first word of the command is looked up in
/// PATH. Everything throws std::runtime_error, also when the program cannot be started.
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
