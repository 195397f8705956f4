#include "renderer/gpu/Timer.h"

#include <cassert>

#include <glad/gl.h>

#include "renderer/gpu/Debug.h"

namespace tessera::gpu {
namespace {

Id timeStamp(const std::string& label) {
    std::uint32_t id = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &id);
    labelObject(LabelKind::Query, id, label);
    return Id(id);
}

std::uint64_t nanoseconds(const Id& query) {
    GLuint64 value = 0;
    glGetQueryObjectui64v(query.value(), GL_QUERY_RESULT, &value);
    return value;
}

} // namespace

GpuTimer::GpuTimer(const std::string& label) {
    for (Slot& slot : slots_) {
        slot.begin = timeStamp(label + " begin");
        slot.end = timeStamp(label + " end");
    }
}

GpuTimer::~GpuTimer() {
    for (const Slot& slot : slots_)
        for (const std::uint32_t id : {slot.begin.value(), slot.end.value()})
            if (id != 0) glDeleteQueries(1, &id);
}

void GpuTimer::begin() {
    assert(!open_);
    open_ = true;
    latestMs(); // frees the slots that are done
    measuring_ = !slots_[next_].pending;
    if (measuring_) glQueryCounter(slots_[next_].begin.value(), GL_TIMESTAMP);
}

void GpuTimer::end() {
    assert(open_);
    open_ = false;
    if (!measuring_) return;
    glQueryCounter(slots_[next_].end.value(), GL_TIMESTAMP);
    slots_[next_].pending = true;
    next_ = (next_ + 1) % kSlots;
}

std::optional<double> GpuTimer::latestMs() {
    for (std::size_t i = 0; i < kSlots && slots_[oldest_].pending; ++i) {
        GLint available = GL_FALSE;
        glGetQueryObjectiv(slots_[oldest_].end.value(), GL_QUERY_RESULT_AVAILABLE, &available);
        if (!available) break;
        const double elapsedNs = double(nanoseconds(slots_[oldest_].end) - nanoseconds(slots_[oldest_].begin));
        latestMs_ = elapsedNs * 1e-6;
        slots_[oldest_].pending = false;
        oldest_ = (oldest_ + 1) % kSlots;
    }
    return latestMs_;
}

} // namespace tessera::gpu
