#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <pybind11/pybind11.h>
#include <sys/types.h>

#include "renderer/gpu/Context.h"

namespace tessera::python {

/// A job was given up, as its stop was requested.
class Stopped : public std::exception {
public:
    const char* what() const noexcept override { return "the work was given up"; }
};

/// Work under way. Steps may be counted from any thread.
class Job {
public:
    /// So many steps are to come; those done are counted from 0 again.
    void expect(std::size_t steps) {
        done_ = 0;
        expected_ = steps;
    }
    /// Throws Stopped where a stop was requested.
    void advance(std::size_t steps = 1) {
        done_ += steps;
        check();
    }
    void check() const {
        if (stop_.stop_requested()) throw Stopped();
    }
    std::stop_token stop() const { return stop_.get_token(); }
    void requestStop() { stop_.request_stop(); }
    std::size_t done() const { return done_; }
    std::size_t expected() const { return expected_; }

private:
    std::atomic<std::size_t> done_ = 0, expected_ = 0;
    std::stop_source stop_;
};

/// The one thread that has the OpenGL context: whatever thread of Python asks for work, it is done there, in turn. The
/// caller waits without the interpreter's lock, and meanwhile handles signals and tells of progress.
class Worker {
public:
    static Worker& get();

    /// Does the work, and then issues what was warned of as Python's warnings. The caller holds the interpreter's lock.
    /// `progress`, a callable or None, is called with steps done and expected, on the caller's thread. Throws what the
    /// work throws, and what signals' handlers and `progress` raise: then the work is stopped at its next step, and
    /// what they raised is thrown when it has. Throws std::runtime_error in a process that was forked from the
    /// worker's.
    void run(const pybind11::object& progress, const std::function<void(Job&)>& work);

    /// Has something destroyed there, and does not wait. What is left of it in a forked process stays as it is.
    void destroyThere(std::function<void()> destroy);
    /// Calls it there when the interpreter ends, before the context goes.
    void atEnd(std::function<void()> last);

    /// Made when it is first asked for; on the worker's thread only.
    gpu::Context& context();
    /// Of which kind; throws std::runtime_error once there is one of another. Where none could be made, there is none.
    void chooseContext(gpu::ContextKind kind);

    /// Ends the thread. Later run()s throw std::runtime_error.
    void end();

private:
    struct Task;
    Worker();
    void work();
    bool isForked() const;

    pid_t process_;
    std::mutex mutex_; ///< of what follows, but for the context
    std::condition_variable changed_;
    std::deque<std::shared_ptr<Task>> tasks_;
    std::vector<std::function<void()>> last_;
    bool isEnding_ = false, hasContext_ = false;
    gpu::ContextKind kind_ = gpu::ContextKind::Auto;
    std::unique_ptr<gpu::Context> context_;
    std::thread thread_;
};

} // namespace tessera::python
