#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "renderer/frame/Diffusion.h"

/// A frame's diffusion work, scheduled before the passes run.
namespace tessera::frame {

/// Constant revision of the textures that keep diffused light from frame to frame: DiffusionMemory tracks their
/// validity per tile.
inline constexpr std::uint64_t kDiffusedLightRevision = 1;

/// A frame's diffusion work for one object.
struct DiffusionTask {
    DiffusionWork work;
    bool lights = true;   ///< renders the irradiance of texels
    bool diffuses = true; ///< diffuses it and stores the result; else a later frame does
    /// Completion callbacks of the passes; empty in a plan.
    std::function<void()> lit, stored, blanked;
};

/// Schedules the tiles that a frame lights, diffuses and blanks. Only this class accesses a view's memory while passes
/// are declared; the passes record their results as they run.
class DiffusionSchedule {
public:
    struct Object {
        std::vector<double> variancesSquareMetres;         ///< LevelReach::mostSquareMetres() of its levels
        std::uint64_t key = 0;                             ///< hash of all inputs of its light
        const std::vector<DiffusionTile>* tiles = nullptr; ///< of its UV atlas
        TileSet seen;
    };
    /// `objects` by cell of the view's DiffusionAtlas; `holdsAtlas`: an earlier frame left it. Without `memory`: a
    /// plan, whose tasks include every pass. `objectDiffused` is called after an object's light is stored; may be
    /// empty.
    DiffusionSchedule(DiffusionMemory* memory, std::vector<Object> objects, bool holdsAtlas,
                      std::function<void()> objectDiffused = {});

    /// Whether the frame leaves the cell as it is.
    bool leaves(std::size_t cell) const;
    /// The task of a cell for which leaves() is false. Call in ascending order of cells, since they share the frame's
    /// limit. `holdsLight`: an earlier frame left the object's irradiance.
    DiffusionTask next(std::size_t cell, bool holdsLight);

private:
    DiffusionMemory* memory_;
    std::vector<Object> objects_;
    bool holdsAtlas_;
    bool writes_ = false; ///< some task so far writes the atlas
    std::function<void()> objectDiffused_;
};

} // namespace tessera::frame
