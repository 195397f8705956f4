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

/// Thrown by a job whose stop was requested.
class Stopped : public std::exception {
public:
    const char* what() const noexcept override { return "the work was given up"; }
};

/// Progress and stop flag of running work. Steps may be counted from any thread.
class Job {
public:
    /// Sets the number of steps to come and resets the number done.
    void expect(std::size_t steps) {
        done_ = 0;
        expected_ = steps;
    }
    /// Counts finished steps. Throws Stopped if a stop was requested.
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

/// The single thread that owns the OpenGL context. Work requested by any Python thread runs on it, in order. The caller
/// waits without the interpreter's lock, and meanwhile handles signals and reports progress.
class Worker {
public:
    static Worker& get();

    /// Runs the work, then issues its logged warnings as Python warnings. The caller holds the interpreter's lock.
    /// `progress`, a callable or None, is called with (steps done, expected) on the caller's thread. Rethrows the
    /// work's exceptions. If a signal handler or `progress` raises, the work stops at its next step and the exception
    /// is then rethrown. Throws std::runtime_error in a process forked from the worker's.
    void run(const pybind11::object& progress, const std::function<void(Job&)>& work);

    /// Calls `destroy` on the worker's thread, without waiting. Does nothing in a forked process or after end().
    void destroyThere(std::function<void()> destroy);
    /// Calls `last` on the worker's thread when the interpreter ends, before the context is destroyed.
    void atEnd(std::function<void()> last);

    /// Created on first use; on the worker's thread only.
    gpu::Context& context();
    /// Throws std::runtime_error once a context of another kind exists; failed attempts to create one do not count.
    void chooseContext(gpu::ContextKind kind);

    /// Ends the thread. Later run()s throw std::runtime_error.
    void end();

private:
    struct Task;
    Worker();
    void work();
    bool isForked() const;

    pid_t process_;
    std::mutex mutex_; ///< guards tasks_, last_, isEnding_, hasContext_ and kind_
    std::condition_variable changed_;
    std::deque<std::shared_ptr<Task>> tasks_;
    std::vector<std::function<void()>> last_;
    bool isEnding_ = false, hasContext_ = false;
    gpu::ContextKind kind_ = gpu::ContextKind::Auto;
    std::unique_ptr<gpu::Context> context_;
    std::thread thread_;
};

} // namespace tessera::python
