#include "renderer/gpu/SampleCounter.h"

#include <glad/gl.h>

namespace tessera::gpu {

SampleCounter::SampleCounter() {
    std::uint32_t id = 0;
    glCreateQueries(GL_SAMPLES_PASSED, 1, &id);
    id_ = Id(id);
}

SampleCounter::~SampleCounter() {
    if (const std::uint32_t id = id_.value()) glDeleteQueries(1, &id);
}

void SampleCounter::begin() {
    glBeginQuery(GL_SAMPLES_PASSED, id_.value());
}

void SampleCounter::end() {
    glEndQuery(GL_SAMPLES_PASSED);
}

std::uint64_t SampleCounter::samples() const {
    GLuint64 value = 0;
    glGetQueryObjectui64v(id_.value(), GL_QUERY_RESULT, &value);
    return value;
}

} // namespace tessera::gpu
