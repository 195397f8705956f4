#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// How the lights that a pixel visits are chosen. Names are those of the command line; the table is the only list.
namespace tessera::culling {

enum class Method : std::uint8_t { None, TileMinmax, Tile25d, Cluster, Zbin };
struct MethodInfo {
    Method method;
    std::string_view name;
    std::string_view summary;
    bool oneListATile;     ///< whatever the depth
    bool mayCullByNormals; ///< a list is of the surfaces of one cell
};
std::span<const MethodInfo> methodTable();
const MethodInfo& infoOf(Method method);

/// Who builds the lists.
enum class Builder : std::uint8_t { Cpu, Compute };
struct BuilderInfo {
    Builder builder;
    std::string_view name;
    std::string_view summary;
};
std::span<const BuilderInfo> builderTable();
const BuilderInfo& infoOf(Builder builder);

/// Which cells leave out the lights behind all their opaque surfaces, where normals are stored.
enum class NormalTest : std::uint8_t { Off, On, WhereWorth };
struct NormalTestInfo {
    NormalTest test;
    std::string_view name;
    std::string_view summary;
};
std::span<const NormalTestInfo> normalTestTable();
const NormalTestInfo& infoOf(NormalTest test);

/// Entries of a list, on average, from which on NormalTest::WhereWorth looks at normals: with fewer, decoding the
/// normals of a cell takes longer than visiting the lights (lattice, 128 to 4096 lights).
inline constexpr int kLightsWorthNormals = 12;

/// Tile sides, in pixels.
inline constexpr int kTileSides[] = {8, 16, 32, 64};
inline constexpr int kUsualTilePixels = 16;

/// The requested light culling; values left open follow from technique and backend (chooseCulling).
struct Settings {
    std::optional<Method> method;
    std::optional<int> tilePixels; ///< one of kTileSides
    std::optional<Builder> builder;
    std::optional<NormalTest> normals;
    std::optional<int> lanes; ///< invocations that build a tile's lists together, 1 or 64; of the compute builder
    bool operator==(const Settings&) const = default;
};

/// What a frame does.
struct Choice {
    Method method = Method::None;
    int tilePixels = kUsualTilePixels;
    Builder builder = Builder::Cpu;
    NormalTest normals = NormalTest::Off;
    int lanes = 1;
    bool operator==(const Choice&) const = default;
};

} // namespace tessera::culling
