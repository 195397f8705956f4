#include "renderer/culling/Candidates.h"

#include <algorithm>

namespace tessera::culling {

void Candidates::resize(std::size_t count) {
    index_.resize(count);
    for (std::vector<float>* values : {&x_, &y_, &z_, &squaredRadius_}) values->resize(count);
    mark_.resize(count);
}

void Candidates::assign(std::span<const std::uint32_t> indices, std::span<const shared::CullLight> lights) {
    lights_ = lights;
    resize(indices.size());
    haveSides_ = false;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const shared::CullLight& light = lights[indices[i]];
        index_[i] = indices[i];
        x_[i] = light.sphere.x;
        y_[i] = light.sphere.y;
        z_[i] = light.sphere.z;
        squaredRadius_[i] = light.sphere.w * light.sphere.w;
        haveSides_ = haveSides_ || shared::hasCone(light) || shared::hasFront(light);
    }
}

void Candidates::mark(std::span<const shared::CellBox> boxes) {
    const std::size_t count = index_.size();
    std::fill(mark_.begin(), mark_.end(), std::uint32_t(0));
    const float *x = x_.data(), *y = y_.data(), *z = z_.data(), *squaredRadius = squaredRadius_.data();
    std::uint32_t* const marks = mark_.data();
    for (const shared::CellBox& given : boxes) {
        const shared::CellBox box = given;
        if (haveSides_) {
            for (std::size_t i = 0; i < count; ++i)
                marks[i] |= std::uint32_t(shared::lightTouchesBox(lights_[index_[i]], box));
        } else {
            for (std::size_t i = 0; i < count; ++i)
                marks[i] |= std::uint32_t(shared::squaredDistance(x[i], y[i], z[i], box) <= squaredRadius[i]);
        }
    }
}

void Candidates::appendMarked(std::vector<std::uint32_t>& indices) const {
    const std::size_t first = indices.size();
    indices.resize(first + index_.size());
    std::uint32_t* to = indices.data() + first;
    for (std::size_t i = 0; i < index_.size(); ++i) {
        *to = index_[i];
        to += mark_[i];
    }
    indices.resize(std::size_t(to - indices.data()));
}

void Candidates::copyMarkedTo(Candidates& other) const {
    other.lights_ = lights_;
    other.haveSides_ = haveSides_;
    other.resize(index_.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < index_.size(); ++i) {
        other.mark_[count] = std::uint32_t(i);
        count += mark_[i];
    }
    other.resize(count);
    const auto copy = [&](const auto& from, auto& to) {
        for (std::size_t i = 0; i < count; ++i) to[i] = from[other.mark_[i]];
    };
    copy(index_, other.index_);
    copy(x_, other.x_);
    copy(y_, other.y_);
    copy(z_, other.z_);
    copy(squaredRadius_, other.squaredRadius_);
}

} // namespace tessera::culling
