#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "renderer/frame/Diffusion.h"

/// What a frame does about light that spreads, decided before passes draw it.
namespace tessera::frame {

/// Revision of the textures that keep such light from frame to frame: what is in them is known tile by tile
/// (DiffusionMemory), not by a revision of the whole.
inline constexpr std::uint64_t kSpreadLightRevision = 1;

/// What a frame computes of an object's light.
struct DiffusionTask {
    DiffusionWork work;
    bool lights = true;  ///< texels
    bool spreads = true; ///< what enters them, and stores what leaves; else light that is lit is for a later frame
    /// To be called when it was lit, stored and blanked; empty in a plan.
    std::function<void()> lit, stored, blanked;
};

/// Which tiles of which objects a frame lights, spreads and blanks. Only this reads and changes a view's memory while
/// the view's passes are declared; what the passes have done is noted as they run.
class DiffusionSchedule {
public:
    struct Object {
        std::vector<double> variancesSquareMetres;         ///< LevelReach::mostSquareMetres() of its levels
        std::uint64_t key = 0;                             ///< of all that its light is computed from
        const std::vector<DiffusionTile>* tiles = nullptr; ///< of its UV atlas
        TileSet seen;
    };
    /// By cell of the view's SpreadLightAtlas, of which `holdsAtlas` says whether an earlier frame left it. No memory:
    /// a plan, whose tasks have every pass. `spreadOne` is called when an object's light was stored; may be empty.
    DiffusionSchedule(DiffusionMemory* memory, std::vector<Object> objects, bool holdsAtlas,
                      std::function<void()> spreadOne = {});

    /// Whether the frame leaves the cell as it is.
    bool leaves(std::size_t cell) const;
    /// Of a cell that it does not leave; cells in ascending order, since they share the frame's limit. `holdsLight`:
    /// whether an earlier frame left the object's light as lit.
    DiffusionTask next(std::size_t cell, bool holdsLight);

private:
    DiffusionMemory* memory_;
    std::vector<Object> objects_;
    bool holdsAtlas_;
    bool writes_ = false; ///< some task so far writes the atlas
    std::function<void()> spreadOne_;
};

} // namespace tessera::frame
