#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// Light culling methods. Names are those of the command line; the tables are the only lists.
namespace tessera::culling {

enum class Method : std::uint8_t { None, TileMinmax, Tile25d, Cluster, Zbin };
struct MethodInfo {
    Method method;
    std::string_view name;
    std::string_view summary;
    bool oneListATile;     ///< one list for all depths of a tile
    bool mayCullByNormals; ///< each list belongs to the surfaces of one cell
};
std::span<const MethodInfo> methodTable();
const MethodInfo& infoOf(Method method);

/// Where the lists are built.
enum class Builder : std::uint8_t { Cpu, Compute };
struct BuilderInfo {
    Builder builder;
    std::string_view name;
    std::string_view summary;
};
std::span<const BuilderInfo> builderTable();
const BuilderInfo& infoOf(Builder builder);

/// Which cells leave out lights behind all of their opaque surfaces. Needs stored normals.
enum class NormalTest : std::uint8_t { Off, On, WhereWorth };
struct NormalTestInfo {
    NormalTest test;
    std::string_view name;
    std::string_view summary;
};
std::span<const NormalTestInfo> normalTestTable();
const NormalTestInfo& infoOf(NormalTest test);

/// Mean list length from which NormalTest::WhereWorth reads normals. With shorter lists, decoding a cell's normals
/// takes longer than visiting the lights (lattice, 128 to 4096 lights).
inline constexpr int kLightsWorthNormals = 12;

/// Tile sides, in pixels.
inline constexpr int kTileSides[] = {8, 16, 32, 64};
inline constexpr int kUsualTilePixels = 16;

/// Requested light culling. Unset values follow from technique and backend (chooseCulling).
struct Settings {
    std::optional<Method> method;
    std::optional<int> tilePixels; ///< one of kTileSides
    std::optional<Builder> builder;
    std::optional<NormalTest> normals;
    std::optional<int> lanes; ///< compute builder: invocations that build a tile's lists together, 1 or 64
    bool operator==(const Settings&) const = default;
};

/// The resolved light culling of a frame.
struct Choice {
    Method method = Method::None;
    int tilePixels = kUsualTilePixels;
    Builder builder = Builder::Cpu;
    NormalTest normals = NormalTest::Off;
    int lanes = 1;
    bool operator==(const Choice&) const = default;
};

} // namespace tessera::culling
