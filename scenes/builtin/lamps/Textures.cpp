#include "scenes/builtin/lamps/Textures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/builtin/Noise.h"
#include "scenes/builtin/Pictures.h"
#include "scenes/builtin/Random.h"

namespace tessera::scenes::builtin::lamps {
namespace {

struct Book {
    double end; ///< right edge, 0..1 of the image
    double width;
    glm::dvec3 cover;
    double bandsAt; ///< v of its label
    bool hasBands;
};

constexpr glm::dvec3 kCovers[] = {{0.20, 0.035, 0.030},  {0.045, 0.085, 0.20}, {0.040, 0.13, 0.075},
                                  {0.30, 0.17, 0.075},   {0.11, 0.060, 0.035}, {0.38, 0.32, 0.23},
                                  {0.055, 0.055, 0.065}, {0.26, 0.10, 0.045}};
constexpr glm::dvec3 kLeaf(0.62, 0.44, 0.17); ///< gold leaf on the bands

std::vector<Book> library() {
    constexpr int kBooks = 44;
    Random random(1851);
    std::vector<Book> books;
    double end = 0.0;
    for (int i = 0; i < kBooks; ++i) {
        Book book{};
        book.width = random.between(0.6, 1.5);
        end += book.width;
        book.end = end;
        constexpr double kCoverCount = std::size(kCovers);
        book.cover = kCovers[static_cast<std::size_t>(kCoverCount * random.unit())] * random.between(0.7, 1.3);
        book.bandsAt = random.between(0.18, 0.35);
        book.hasBands = random.unit() < 0.6;
        books.push_back(book);
    }
    for (Book& book : books) {
        book.end /= end;
        book.width /= end;
    }
    return books;
}

} // namespace

Image spineColors() {
    constexpr int kWidth = 512, kHeight = 128;
    const std::vector<Book> books = library();
    return drawColors("spines", kWidth, kHeight, [&](int x, int y) {
        const double u = (x + 0.5) / kWidth, v = (y + 0.5) / kHeight;
        const auto book = std::find_if(books.begin(), books.end() - 1, [&](const Book& b) { return u < b.end; });
        const double across = std::clamp(1.0 - (book->end - u) / book->width, 0.0, 1.0);
        // A spine is round: darker at its joints.
        const double round = std::sqrt(std::max(0.0, 1.0 - std::pow(2.0 * across - 1.0, 4.0)));
        const double worn = 1.0 + 0.15 * fractalNoise({24.0 * u, 6.0 * v, 0.0}, 3, 9, glm::ivec2(24, 6));
        const auto isBand = [&](double at, double half) { return std::abs(v - at) < half; };
        const bool isLeaf = book->hasBands &&
                            (isBand(book->bandsAt, 0.012) || isBand(book->bandsAt + 0.12, 0.012) || isBand(0.9, 0.010));
        return (isLeaf ? kLeaf : book->cover) * worn * (0.25 + 0.75 * round);
    });
}

Image boardColors() {
    constexpr int kSize = 256, kBoards = 12;
    constexpr glm::dvec3 kOak(0.30, 0.165, 0.080);
    return drawColors("oak boards", kSize, kSize, [&](int x, int y) {
        const double u = (x + 0.5) / kSize, v = (y + 0.5) / kSize;
        const int board = static_cast<int>(u * kBoards);
        const double inside = u * kBoards - board;
        // Each board ends once in the image, at its own position.
        const double along = v + hashUnit(board, 0, 0, 3);
        const double toEnd = std::min(along - std::floor(along), std::ceil(along) - along);
        const double tone = 0.75 + 0.5 * hashUnit(board, 1, 0, 3);
        const double grain = 1.0 + 0.22 * fractalNoise({96.0 * u, 4.0 * v, 0.0}, 3, 21, glm::ivec2(96, 4));
        const bool isJoint = std::min(inside, 1.0 - inside) < 0.04 || toEnd < 0.004;
        return kOak * tone * grain * (isJoint ? 0.35 : 1.0);
    });
}

} // namespace tessera::scenes::builtin::lamps
