#include "renderer/frame/DiffusionTiles.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "renderer/frame/Diffusion.h"
#include "renderer/frame/DiffusionSchedule.h"
#include "scenes/LookAt.h"

namespace tessera::frame {
namespace {

constexpr int kSide = 256;
constexpr int kTiles = kSide / kDiffusionTileTexels;

TEST(TileSet, rectanglesCoverItAndNothingElseOnce) {
    std::mt19937 random(1);
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        TileSet set(kTiles);
        for (int i = 0; i < kTiles * kTiles; ++i)
            if (std::bernoulli_distribution(share)(random)) set.add(i);
        constexpr int kCutSide = kSide - 5; // cuts off part of the last tiles
        std::vector<int> covered(std::size_t(kCutSide) * std::size_t(kCutSide), 0);
        for (const gpu::Rectangle& rectangle : set.rectangles(kDiffusionTileTexels, kCutSide))
            for (int v = rectangle.y; v < rectangle.y + rectangle.height; ++v)
                for (int u = rectangle.x; u < rectangle.x + rectangle.width; ++u)
                    ++covered.at(std::size_t(v * kCutSide + u));
        for (int v = 0; v < kCutSide; ++v)
            for (int u = 0; u < kCutSide; ++u)
                ASSERT_EQ(covered[std::size_t(v * kCutSide + u)],
                          set.has(v / kDiffusionTileTexels * kTiles + u / kDiffusionTileTexels) ? 1 : 0);
    }
}

TEST(TileSet, tilesAreAddedAndRemoved) {
    TileSet set(4);
    set.add(8);
    set.add(12);
    EXPECT_EQ(set.count(), 2u);
    EXPECT_TRUE(set.has(8) && set.has(12));
    TileSet other(4);
    other.add(8);
    set.remove(other);
    EXPECT_EQ(set.count(), 1u);
    set.add(other);
    EXPECT_EQ(set.count(), 2u);
    EXPECT_FALSE(set.isEmpty());
    EXPECT_TRUE(TileSet(4).isEmpty());
}

/// A sphere of radius 1 m; u runs around it.
scenes::Mesh globe(int columns, int rows, bool isSheared) {
    scenes::Mesh mesh;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const double u = double(i) / columns, v = double(j) / rows;
            const double around = 2.0 * std::numbers::pi * double(i % columns) / columns, down = std::numbers::pi * v;
            mesh.positionsOS.emplace_back(
                glm::dvec3(std::sin(down) * std::cos(around), std::cos(down), -std::sin(down) * std::sin(around)));
            mesh.normalsOS.push_back(mesh.positionsOS.back());
            mesh.texCoords[0].emplace_back(isSheared ? glm::dvec2(0.7 * u + 0.3 * v, 0.3 * u + 0.7 * v)
                                                     : glm::dvec2(u, v));
        }
    }
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const auto a = std::uint32_t(j * (columns + 1) + i), b = a + 1, c = a + std::uint32_t(columns + 1),
                       d = c + 1;
            if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, c, b});
            if (j + 1 < rows) mesh.indices.insert(mesh.indices.end(), {b, c, d});
        }
    }
    return mesh;
}

/// A globe with its atlas and tiles.
struct TiledGlobe {
    explicit TiledGlobe(int columns, const glm::dmat4& worldFromObject = glm::dmat4(1.0), bool isSheared = false)
        : mesh(globe(columns, columns / 2, isSheared)), atlas(makeUvAtlas(mesh, worldFromObject, kSide, 8, 16)),
          tiles(diffusionTiles(atlas, mesh, worldFromObject)) {}
    scenes::Mesh mesh;
    UvAtlas atlas;
    std::vector<DiffusionTile> tiles;
};

CameraView cameraAt(const glm::dvec3& eyeWS, const glm::dvec3& targetWS, scenes::Projection projection) {
    scenes::Camera camera;
    camera.projection = projection;
    camera.worldFromCamera = scenes::worldFromLookAt(eyeWS, targetWS);
    camera.halfHeightMetres = 0.7;
    camera.fovYRadians = 0.6;
    camera.nearMetres = 0.01;
    return makeCameraView(camera, {600, 400}, LightingSpace::World, glm::vec3(0.0f));
}

void expectHoldsEveryTexel(const TiledGlobe& tiled) {
    const auto& [mesh, atlas, tiles] = tiled;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> share(0.0, 1.0), place(-3.0, 3.0);
    for (int trial = 0; trial < 40; ++trial) {
        glm::dvec3 eyeWS(place(random), place(random), place(random));
        if (glm::length(eyeWS) < 1.1) eyeWS *= 1.5 / glm::length(eyeWS);
        const auto projection = trial % 3 == 0 ? scenes::Projection::Orthographic : scenes::Projection::Perspective;
        const CameraView view = cameraAt(eyeWS, 0.3 * glm::dvec3(place(random), 0.2, place(random)), projection);
        const TileSet seen = seenTiles(tiles, view, 0.0, false), both = seenTiles(tiles, view, 0.0, true);
        std::size_t looked = 0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            glm::dvec3 corners[3];
            for (std::size_t c = 0; c < 3; ++c) corners[c] = glm::dvec3(mesh.positionsOS[mesh.indices[i + c]]);
            const glm::dvec3 front = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            for (int sample = 0; sample < 20; ++sample) {
                double a = share(random), b = share(random);
                if (a + b > 1.0) std::tie(a, b) = std::pair(1.0 - a, 1.0 - b);
                const glm::dvec3 pointWS = corners[0] + a * (corners[1] - corners[0]) + b * (corners[2] - corners[0]);
                const glm::dvec4 clip = view.clipFromLS * glm::dvec4(view.positionLS(pointWS), 1.0);
                if (!(clip.w > 0.0) || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
                const glm::dvec3 toViewer =
                    projection == scenes::Projection::Orthographic ? -view.forwardLS : view.eyeWS - pointWS;
                const bool isFront = glm::dot(front, toViewer) > 0.0;
                const auto texCoord = [&, &mesh = mesh](std::size_t c) {
                    return glm::dvec2(mesh.texCoords[0][mesh.indices[i + c]]);
                };
                const glm::dvec2 at = atlas.placeOf(
                    glm::vec2(texCoord(0) + a * (texCoord(1) - texCoord(0)) + b * (texCoord(2) - texCoord(0))));
                const glm::ivec2 low(glm::floor(at - 0.5));
                for (int k = 0; k < 4; ++k) {
                    const glm::ivec2 texel =
                        glm::clamp(low + glm::ivec2(k & 1, k >> 1), glm::ivec2(0), glm::ivec2(kSide - 1));
                    const glm::ivec2 tile = texel / kDiffusionTileTexels;
                    ASSERT_TRUE(both.has(tile.y * kTiles + tile.x));
                    if (isFront) {
                        ASSERT_TRUE(seen.has(tile.y * kTiles + tile.x));
                    }
                }
                ++looked;
            }
        }
        EXPECT_LE(seen.count(), both.count());
        if (looked > 0) {
            EXPECT_LT(seen.count(), usedTiles(tiles).count());
        }
    }
}

/// In the sheared atlas triangles are larger than tiles, and none has a side along u or v.
TEST(DiffusionTiles, seenTilesHoldEveryTexelThatAPixelMayLookUp) {
    const TiledGlobe straight(48), sheared(6, glm::dmat4(1.0), true);
    for (const TiledGlobe* globe : {&straight, &sheared}) expectHoldsEveryTexel(*globe);
}

TEST(DiffusionTiles, mostOfWhatFacesAwayOrLiesOutsideIsLeftOut) {
    const std::vector<DiffusionTile> tiles = TiledGlobe(96).tiles;
    const auto shareOf = [&](const CameraView& view) {
        return double(seenTiles(tiles, view, 0.0, false).count()) / double(usedTiles(tiles).count());
    };
    const auto perspective = scenes::Projection::Perspective;
    // From three metres a third of the sphere is visible; a tile spans a sixteenth of the circumference.
    EXPECT_LT(shareOf(cameraAt({0.0, 0.0, 3.0}, glm::dvec3(0.0), perspective)), 0.66);
    EXPECT_LT(shareOf(cameraAt({0.0, 0.0, 1.3}, {0.0, 0.0, 0.0}, perspective)), 0.3);
    EXPECT_EQ(shareOf(cameraAt({0.0, 0.0, 3.0}, {0.0, 0.0, 9.0}, perspective)), 0.0) << "behind the viewer";
    // Where triangles are smaller than pixels, rounding may flip any of them.
    EXPECT_EQ(shareOf(cameraAt({0.0, 0.0, 3000.0}, glm::dvec3(0.0), perspective)), 1.0);
}

TEST(DiffusionTiles, aMirroredObjectFacesTheOtherWay) {
    glm::dmat4 mirrored(1.0);
    mirrored[2][2] = -1.0;
    const CameraView view = cameraAt({0.0, 0.0, 3.0}, glm::dvec3(0.0), scenes::Projection::Perspective);
    const TileSet seen = seenTiles(TiledGlobe(96, mirrored).tiles, view, 0.0, false);
    // u = 1/4 is at z = -1, here mirrored to the front; u = 3/4 behind it.
    const int middle = kTiles / 2 * kTiles;
    EXPECT_TRUE(seen.has(middle + kTiles / 4));
    EXPECT_FALSE(seen.has(middle + 3 * kTiles / 4));
}

TEST(DiffusionTiles, workGrowsByWhatEachPassReads) {
    const auto& [mesh, atlas, tiles] = TiledGlobe(48);
    TileSet store(kTiles);
    store.add(8 * kTiles + 8);
    const auto holds = [](const TileSet& all, const TileSet& some) {
        TileSet rest = some;
        rest.remove(all);
        return rest.isEmpty();
    };
    const DiffusionWork none = diffusionWork(tiles, {}, store);
    EXPECT_EQ(none.light, store) << "in the middle of a chart nothing goes on elsewhere";
    const DiffusionWork work = diffusionWork(tiles, {1e-6, 1e-3}, store);
    ASSERT_EQ(work.levels.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_TRUE(holds(work.levels[i].alongU, work.levels[i].alongV));
        EXPECT_TRUE(holds(work.levels[i].fill, work.levels[i].alongU));
    }
    EXPECT_TRUE(holds(work.levels[0].alongV, work.levels[1].fill));
    EXPECT_TRUE(holds(work.light, work.levels[0].fill));
    // Texels are 2 pi / 240 m wide at the equator and half as high: 3.5 deviations of 32 mm are 5 and 9 texels.
    EXPECT_LE(work.light.count(), 15u);
    // A Gaussian as wide as the object needs every tile.
    EXPECT_EQ(diffusionWork(tiles, {1.0}, store).light.count(), TileSet(kTiles, true).count());
    // Light diffuses across the seam of u, which lies half a tile within the atlas, to the other end.
    TileSet seam(kTiles);
    seam.add(8 * kTiles);
    ASSERT_FALSE(atlas.at(4, 130).isCovered);
    const TileSet lit = diffusionWork(tiles, {}, seam).light;
    EXPECT_TRUE(lit.has(8 * kTiles + kTiles - 1)) << "the seam's other side";
}

TEST(DiffusionMemory, hasTilesForTheKeyTheyWereComputedUnder) {
    TileSet a(2), b(2), all(2, true);
    a.add(0);
    b.add(1);
    DiffusionMemory memory;
    memory.begin(2, false);
    EXPECT_EQ(memory.missing(1, 7, all).count(), 4u);
    memory.hold(1, 7, all, a);
    memory.hold(1, 7, {}, b);
    EXPECT_EQ(memory.missing(1, 7, all).count(), 2u);
    EXPECT_EQ(memory.unlit(1, 7, all).count(), 0u);
    EXPECT_EQ(memory.missing(0, 7, all).count(), 4u) << "another cell";
    EXPECT_EQ(memory.missing(1, 8, all).count(), 4u) << "another key";
    EXPECT_EQ(memory.unlit(1, 8, all).count(), 4u);
    memory.begin(2, false); // the atlas was freed, the entering light was not
    EXPECT_EQ(memory.missing(1, 7, all).count(), 4u);
    EXPECT_EQ(memory.unlit(1, 7, all).count(), 0u);
    memory.hold(1, 7, {}, a);
    memory.forgetLit(1);
    EXPECT_EQ(memory.unlit(1, 7, all).count(), 4u);
    EXPECT_EQ(memory.missing(1, 7, all).count(), 3u);
    memory.hold(1, 9, b, b);
    EXPECT_EQ(memory.missing(1, 9, all).count(), 3u) << "what was known before is of another key";
    memory.forget();
    EXPECT_EQ(memory.missing(1, 9, all).count(), 4u);
}

/// Separate tiles: each depends on itself alone.
std::vector<DiffusionTile> tilesApart(int side) {
    std::vector<DiffusionTile> tiles(std::size_t(side) * std::size_t(side));
    for (DiffusionTile& tile : tiles) tile.boxWS.extend(glm::dvec3(0.0));
    return tiles;
}

TEST(DiffusionMemory, aLimitedFrameTakesTilesUntilAllAreThere) {
    constexpr int kTilesASide = 6;
    const std::vector<DiffusionTile> tiles = tilesApart(kTilesASide);
    const TileSet all(kTilesASide, true);
    DiffusionMemory memory;
    memory.begin(1, true);
    int frames = 0;
    for (; !memory.missing(0, 7, all).isEmpty(); ++frames) {
        ASSERT_LT(frames, 100);
        memory.limit(3);
        const DiffusionWork work = memory.next(0, 7, tiles, {}, all);
        EXPECT_LE(work.light.count(), 3u);
        if (!work.store.isEmpty()) {
            TileSet unlit = memory.unlit(0, 7, work.store);
            unlit.remove(work.light);
            EXPECT_TRUE(unlit.isEmpty()) << "absent light is diffused";
        }
        EXPECT_EQ(work.blank.isEmpty(), frames > 0) << "the first frame reports the unknown texels";
        memory.hold(0, 7, work.light, {});
        memory.hold(0, 7, {}, work.store);
        memory.holdBlank(0, 7, work.blank);
    }
    EXPECT_GE(frames, kTilesASide * kTilesASide / 3);

    memory.limit(0);
    EXPECT_FALSE(memory.isIdle(0, 8, all)) << "what is there is of another key";
    const DiffusionWork none = memory.next(0, 8, tiles, {}, all);
    EXPECT_TRUE(none.light.isEmpty() && none.store.isEmpty());
    EXPECT_EQ(none.blank, all);
    memory.holdBlank(0, 8, none.blank);
    EXPECT_TRUE(memory.isIdle(0, 8, all)) << "no light may be added, and the atlas says so";
    memory.begin(1, false);
    EXPECT_FALSE(memory.isIdle(0, 8, all)) << "the atlas was freed";
    memory.limit({});
    EXPECT_EQ(memory.next(0, 8, tiles, {}, all).store, all);
    EXPECT_TRUE(memory.next(0, 8, tiles, {}, all).blank.isEmpty());
}

/// The schedule's entry of an object whose tiles are all visible.
DiffusionSchedule::Object objectOf(const std::vector<DiffusionTile>& tiles, int side, std::uint64_t key) {
    return {{}, key, &tiles, TileSet(side, true)};
}

TEST(DiffusionSchedule, hasEveryPassInAPlan) {
    DiffusionSchedule plan(nullptr, {{{1e-6, 2e-6}, 0, nullptr, {}}, {}}, false);
    for (const std::size_t cell : {std::size_t(0), std::size_t(1)}) {
        EXPECT_FALSE(plan.leaves(cell));
        const DiffusionTask task = plan.next(cell, false);
        EXPECT_TRUE(task.lights && task.diffuses);
        EXPECT_EQ(task.work.levels.size(), cell == 0 ? 2u : 0u);
        EXPECT_FALSE(task.lit || task.stored || task.blanked);
    }
}

TEST(DiffusionSchedule, lightsAndDiffusesOnceAndLeavesWhatIsKnown) {
    const std::vector<DiffusionTile> tiles = tilesApart(2);
    const TileSet all(2, true);
    DiffusionMemory memory;
    int reported = 0;
    const auto frame = [&](std::uint64_t key, bool holdsAtlas) {
        return DiffusionSchedule(&memory, {objectOf(tiles, 2, key)}, holdsAtlas, [&] { ++reported; });
    };
    DiffusionSchedule first = frame(7, false);
    ASSERT_FALSE(first.leaves(0));
    DiffusionTask task = first.next(0, false);
    EXPECT_TRUE(task.lights && task.diffuses);
    EXPECT_EQ(task.work.light, all);
    EXPECT_EQ(task.work.store, all);
    EXPECT_TRUE(task.work.blank.isEmpty());
    EXPECT_EQ(memory.missing(0, 7, all), all) << "nothing is known before the passes have run";
    task.lit();
    task.stored();
    EXPECT_EQ(reported, 1);
    EXPECT_TRUE(frame(7, true).leaves(0));
    EXPECT_FALSE(frame(8, true).leaves(0)) << "what enters has changed";

    DiffusionSchedule freed = frame(7, false);
    EXPECT_FALSE(freed.leaves(0)) << "the atlas was freed";
    task = freed.next(0, true);
    EXPECT_FALSE(task.lights) << "what has entered is kept";
    EXPECT_TRUE(task.diffuses);
    EXPECT_EQ(task.work.store, all);
    task = frame(7, false).next(0, false);
    EXPECT_TRUE(task.lights) << "that was freed too";
    EXPECT_EQ(task.work.light, all);
}

TEST(DiffusionSchedule, writesAnAtlasBeforeItIsReadThoughNothingIsSeen) {
    const std::vector<DiffusionTile> tiles = tilesApart(2);
    DiffusionMemory memory;
    const DiffusionSchedule::Object unseen{{}, 7, &tiles, TileSet(2)};
    DiffusionSchedule schedule(&memory, {unseen, unseen}, false);
    EXPECT_TRUE(schedule.leaves(0)) << "the second may do it";
    ASSERT_FALSE(schedule.leaves(1));
    const DiffusionTask task = schedule.next(1, false);
    EXPECT_TRUE(task.lights && task.diffuses) << "which reads light that must have been written";
    EXPECT_TRUE(task.work.light.isEmpty() && task.work.store.isEmpty());
    EXPECT_TRUE(DiffusionSchedule(&memory, {unseen, unseen}, true).leaves(1));
}

TEST(DiffusionSchedule, sharesTheFramesLimitAmongObjects) {
    const std::vector<DiffusionTile> tiles = tilesApart(3);
    DiffusionMemory memory;
    memory.limit(3);
    DiffusionSchedule schedule(&memory, {objectOf(tiles, 3, 7), objectOf(tiles, 3, 7)}, false);
    const DiffusionTask one = schedule.next(0, false), other = schedule.next(1, false);
    EXPECT_EQ(one.work.light.count(), 3u);
    EXPECT_TRUE(one.lights);
    EXPECT_FALSE(one.diffuses) << "not all of its light is there";
    EXPECT_FALSE(other.lights || other.diffuses) << "the limit is spent";
    EXPECT_EQ(other.work.blank.count(), 9u) << "the atlas must say that nothing is known";
}

TEST(TileSet, takesTheFirstOfItsTiles) {
    TileSet some(3);
    for (const int tile : {1, 4, 8}) some.add(tile);
    EXPECT_TRUE(some.first(0).isEmpty());
    EXPECT_TRUE(some.first(2).has(1) && some.first(2).has(4));
    EXPECT_EQ(some.first(2).count(), 2u);
    EXPECT_EQ(some.first(9), some);
}

} // namespace
} // namespace tessera::frame
