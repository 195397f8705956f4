#include "validation/reference/Pyramid.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace tessera::reference {

namespace {

/// Texels of the previous level that one texel of a level covers, along one axis.
struct Cover {
    int first = 0, last = 0;
    double begin = 0.0, end = 0.0; ///< in texels

    Cover(int index, int size, int sizeBefore)
        : begin(double(index) * sizeBefore / size), end(double(index + 1) * sizeBefore / size) {
        first = int(std::floor(begin));
        last = std::min(int(std::ceil(end)), sizeBefore) - 1;
    }
    /// The fraction of the whole that one texel makes up.
    double share(int texel) const {
        return (std::min(end, texel + 1.0) - std::max(begin, double(texel))) / (end - begin);
    }
};

} // namespace

Pyramid::Pyramid(const scenes::Image& image, Transfer transfer, bool hasLevels) : image_(&image), transfer_(transfer) {
    while (hasLevels && std::max(sizeTexels(smallestLevel()).x, sizeTexels(smallestLevel()).y) > 1)
        smaller_.push_back(halved(smallestLevel()));
}

glm::ivec2 Pyramid::sizeTexels(int level) const {
    return level == 0 ? glm::ivec2(image_->width, image_->height) : smaller_[std::size_t(level) - 1].sizeTexels;
}

glm::dvec4 Pyramid::texel(int level, int column, int row) const {
    if (level == 0) return texelAt(*image_, transfer_, column, row);
    const Level& own = smaller_[std::size_t(level) - 1];
    return glm::dvec4(own.texels[std::size_t(row) * std::size_t(own.sizeTexels.x) + std::size_t(column)]);
}

Pyramid::Level Pyramid::halved(int level) const {
    const glm::ivec2 before = sizeTexels(level);
    Level next;
    next.sizeTexels = glm::max(before / 2, glm::ivec2(1));
    next.texels.resize(std::size_t(next.sizeTexels.x) * std::size_t(next.sizeTexels.y));
    tbb::parallel_for(0, next.sizeTexels.y, [&](int row) {
        const Cover rows(row, next.sizeTexels.y, before.y);
        for (int column = 0; column < next.sizeTexels.x; ++column) {
            const Cover columns(column, next.sizeTexels.x, before.x);
            glm::dvec4 mean(0.0);
            for (int y = rows.first; y <= rows.last; ++y)
                for (int x = columns.first; x <= columns.last; ++x)
                    mean += rows.share(y) * columns.share(x) * texel(level, x, y);
            next.texels[std::size_t(row) * std::size_t(next.sizeTexels.x) + std::size_t(column)] = glm::vec4(mean);
        }
    });
    return next;
}

} // namespace tessera::reference
