#include "tests/support/LightTable.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

namespace tessera::validation {

namespace {

using culling::Method;
using engine::Technique;

/// The deferred technique that supports a method.
Technique deferredTechnique(Method method) {
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
        const bool supports = std::ranges::find(technique.methods, method) != technique.methods.end();
        if (technique.usesGBuffer() && supports) return technique.technique;
    }
    assert(method == Method::None);
    return Technique::Deferred;
}

std::string ratioText(const std::optional<double>& ratio) {
    return ratio ? fmt::format("{:.3f}", *ratio) : "-";
}

std::string rowText(const LightTableRow& row) {
    const LightOracleFigures& figures = row.figures;
    const std::string_view name = infoOf(row.method).name;
    const std::string tile = row.tilePixels == 0 ? "-" : fmt::format("{}", row.tilePixels);
    return fmt::format("{:<12} {:>4} {:>8.2f} {:>6} {:>6} {:>9} {:>9} {:>8.2f} {:>6} {:>6} {:>9} {:>8} {:>11} {:>6}\n",
                       name, tile, figures.perPixel(figures.evaluated + figures.everywhere), figures.evaluatedP99,
                       figures.evaluatedMax, ratioText(figures.tightness()), ratioText(figures.litTightness()),
                       figures.occupied.mean, figures.occupied.p99, figures.occupied.max, figures.occupied.count,
                       figures.entries, figures.listBytes, figures.falseNegatives);
}

} // namespace

std::vector<LightTableRow> judgeCulling(engine::Renderer& renderer, const frame::FrameSettings& settings,
                                        std::span<const int> tileSides) {
    std::vector<LightTableRow> rows;
    frame::FrameSettings requested = settings;
    for (const culling::MethodInfo& info : culling::methodTable()) {
        const bool hasTiles = info.method != Method::None;
        const Technique technique = deferredTechnique(info.method);
        requested.culling = {};
        requested.culling.normals = settings.culling.normals;
        if (hasTiles) requested.culling.method = info.method;
        for (const int tilePixels : hasTiles ? tileSides : std::span<const int>(&tileSides.front(), 1)) {
            if (hasTiles) requested.culling.tilePixels = tilePixels;
            rows.push_back({info.method, hasTiles ? tilePixels : 0, judgeLights(renderer, technique, requested)});
        }
    }
    return rows;
}

std::string lightTable(std::span<const LightTableRow> rows) {
    if (rows.empty()) return {};
    const LightOracleFigures& frame = rows.front().figures;
    std::string text = fmt::format(
        "{} covered pixels, each needs {:.2f} lights, {:.2f} of them with n.l > 0, and {:.2f} that reach everywhere\n",
        frame.covered, frame.perPixel(frame.needed), frame.perPixel(frame.neededLit), frame.perPixel(frame.everywhere));
    text +=
        "               lights visited by a pixel    visited /          lights in a cell                     list   "
        "    missed\n";
    text += fmt::format("{:<12} {:>4} {:>8} {:>6} {:>6} {:>9} {:>9} {:>8} {:>6} {:>6} {:>9} {:>8} {:>11} {:>6}\n",
                        "method", "tile", "mean", "p99", "max", "needed", "lit", "mean", "p99", "max", "cells",
                        "entries", "bytes", "pairs");
    for (const LightTableRow& row : rows) text += rowText(row);
    return text;
}

} // namespace tessera::validation
