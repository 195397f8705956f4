#include "renderer/culling/CullingMethod.h"

#include <iterator>

#include "base/EnumTable.h"

namespace tessera::culling {

namespace {

constexpr MethodInfo kMethods[] = {
    {Method::None, "none", "no lists: every pixel visits every light", false, false},
    {Method::TileMinmax, "tile_minmax", "one list a tile: its frustum between the nearest and farthest surface", true,
     true},
    {Method::Tile25d, "tile_2.5d", "one list a tile: only the slices of depth that hold a surface", true, true},
    {Method::Cluster, "cluster", "one list for each slice of a tile's depth that holds a surface", false, true},
    {Method::Zbin, "zbin", "a bitmask a tile and one a depth bin; a pixel visits what is in both", false, false},
};

constexpr NormalTestInfo kNormalTests[] = {
    {NormalTest::Off, "off", "lists hold every light that reaches a cell"},
    {NormalTest::On, "on", "cells leave out the lights behind all their surfaces"},
    {NormalTest::WhereWorth, "where_worth", "only where lists are long enough to gain from it"},
};

constexpr BuilderInfo kBuilders[] = {
    {Builder::Cpu, "cpu", "all cores, from the depth buffer read back"},
    {Builder::Compute, "compute", "compute shaders"},
};

static_assert(isInOrder(kMethods, &MethodInfo::method, std::size(kMethods)));
static_assert(isInOrder(kNormalTests, &NormalTestInfo::test, std::size(kNormalTests)));
static_assert(isInOrder(kBuilders, &BuilderInfo::builder, std::size(kBuilders)));

} // namespace

std::span<const MethodInfo> methodTable() {
    return kMethods;
}

const MethodInfo& infoOf(Method method) {
    return kMethods[std::size_t(method)];
}

std::span<const NormalTestInfo> normalTestTable() {
    return kNormalTests;
}

const NormalTestInfo& infoOf(NormalTest test) {
    return kNormalTests[std::size_t(test)];
}

std::span<const BuilderInfo> builderTable() {
    return kBuilders;
}

const BuilderInfo& infoOf(Builder builder) {
    return kBuilders[std::size_t(builder)];
}

} // namespace tessera::culling
