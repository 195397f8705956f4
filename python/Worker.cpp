#include "python/Worker.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <unistd.h>

#include "apps/Keywords.h"
#include "base/OneLine.h"
#include "python/Log.h"
#include "renderer/frame/ComputedCache.h"

namespace py = pybind11;

namespace tessera::python {

namespace {

/// Interval at which a waiting caller handles signals, such as Ctrl-C, and reports progress.
constexpr std::chrono::milliseconds kPause(50);

/// Issues Python warnings; file names in them may hold bytes that are not UTF-8. Throws if a warning filter raises one.
void warn(const std::vector<std::string>& messages) {
    for (const std::string& message : messages) {
        const std::string text = oneLine(app::withKeywords(message));
        if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
    }
}

} // namespace

struct Worker::Task {
    std::function<void(Job&)> work;
    Job job;
    std::mutex mutex;
    std::condition_variable ended;
    bool hasEnded = false; ///< guarded by mutex; the members below are written before it is set
    std::exception_ptr error;
    std::vector<std::string> warnings;

    void run() {
        try {
            work(job);
        } catch (...) {
            error = std::current_exception();
        }
        work = {};
        warnings = takeLog();
        if (std::string fault = frame::takeCacheFault(); !fault.empty()) warnings.push_back(std::move(fault));
        const std::lock_guard lock(mutex);
        hasEnded = true;
        ended.notify_all();
    }
    bool endsWithin(std::chrono::milliseconds time) {
        std::unique_lock lock(mutex);
        return ended.wait_for(lock, time, [this] { return hasEnded; });
    }
};

Worker& Worker::get() {
    // Never destroyed: end() ends the thread while the interpreter still exists.
    static Worker* const worker = new Worker;
    return *worker;
}

Worker::Worker() : process_(getpid()) {
    thread_ = std::thread([this] { work(); });
}

bool Worker::isForked() const {
    return getpid() != process_;
}

void Worker::work() {
    for (;;) {
        std::shared_ptr<Task> task;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return isEnding_ || !tasks_.empty(); });
            if (tasks_.empty()) break;
            task = std::move(tasks_.front());
            tasks_.pop_front();
        }
        task->run();
    }
    for (const std::function<void()>& last : last_) last();
    context_.reset();
}

void Worker::run(const py::object& progress, const std::function<void(Job&)>& work) {
    if (isForked())
        throw std::runtime_error("this process was forked from one that uses tessera, whose OpenGL does not outlive a "
                                 "fork; start processes with multiprocessing.get_context('spawn')");
    const auto task = std::make_shared<Task>();
    task->work = work;
    {
        const py::gil_scoped_release unlocked;
        const std::lock_guard lock(mutex_);
        if (isEnding_) throw std::runtime_error("the interpreter ends; nothing more is rendered");
        tasks_.push_back(task);
        changed_.notify_all();
    }
    std::exception_ptr raised;
    std::size_t reported = 0;
    const auto report = [&] {
        const std::size_t expected = task->job.expected(), done = std::min(task->job.done(), expected);
        if (progress.is_none() || expected == 0 || done == reported) return;
        reported = done;
        progress(done, expected);
    };
    const auto isDone = [&] {
        const py::gil_scoped_release unlocked;
        return task->endsWithin(kPause);
    };
    while (!isDone()) {
        if (raised) continue;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            report();
        } catch (py::error_already_set&) {
            raised = std::current_exception();
            task->job.requestStop();
        }
    }
    if (raised) std::rethrow_exception(raised);
    if (task->error) std::rethrow_exception(task->error);
    report();
    warn(task->warnings);
}

void Worker::destroyThere(std::function<void()> destroy) {
    if (isForked()) return;
    const auto task = std::make_shared<Task>();
    task->work = [destroy = std::move(destroy)](Job&) { destroy(); };
    const std::lock_guard lock(mutex_);
    if (isEnding_) return; // atEnd() has freed the large data
    tasks_.push_back(task);
    changed_.notify_all();
}

void Worker::atEnd(std::function<void()> last) {
    const std::lock_guard lock(mutex_);
    last_.push_back(std::move(last));
}

gpu::Context& Worker::context() {
    if (!context_) {
        gpu::ContextOptions options;
        {
            const std::lock_guard lock(mutex_);
            options.kind = kind_;
            hasContext_ = true;
        }
        try {
            context_ = gpu::Context::create(options);
        } catch (...) { // another kind may work
            const std::lock_guard lock(mutex_);
            hasContext_ = false;
            throw;
        }
    }
    return *context_;
}

void Worker::chooseContext(gpu::ContextKind kind) {
    const std::lock_guard lock(mutex_);
    if (hasContext_ && kind != kind_)
        throw std::runtime_error("OpenGL is in use already; call use_context() before the first picture");
    kind_ = kind;
}

void Worker::end() {
    if (isForked()) return;
    {
        const std::lock_guard lock(mutex_);
        if (isEnding_) return;
        isEnding_ = true;
        changed_.notify_all();
    }
    thread_.join();
}

} // namespace tessera::python
