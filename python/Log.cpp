#include "python/Log.h"

#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

namespace tessera::python {

namespace {

class KeptLines : public spdlog::sinks::base_sink<std::mutex> {
public:
    std::vector<std::string> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(lines_, {});
    }

protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        lines_.emplace_back(message.payload.data(), message.payload.size());
    }
    void flush_() override {}

private:
    std::vector<std::string> lines_; ///< guarded by mutex_
};

const std::shared_ptr<KeptLines>& keptLines() {
    static const auto lines = std::make_shared<KeptLines>();
    return lines;
}

} // namespace

void keepLog() {
    const auto logger = std::make_shared<spdlog::logger>("tessera", keptLines());
    logger->set_level(spdlog::level::warn);
    spdlog::set_default_logger(logger);
}

std::vector<std::string> takeLog() {
    return keptLines()->take();
}

} // namespace tessera::python
