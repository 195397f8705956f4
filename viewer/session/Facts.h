#pragma once
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/Renderer.h"
#include "renderer/graph/Plan.h"
#include "validation/culling/LightOracle.h"
#include "validation/figures/ErrorFigures.h"
#include "viewer/edit/Contour.h"
#include "viewer/session/Inspection.h"
#include "viewer/session/Look.h"
#include "viewer/session/ResourceView.h"

namespace tessera::viewer {

/// What takes long, for the box over the picture.
struct Progress {
    std::string text;            ///< "Drawing at scale 0.5"
    std::optional<double> share; ///< that is done; none: nobody knows
    bool canCancel = false;      ///< by Esc
    bool operator==(const Progress&) const = default;
};

/// What panels show of the frames that were drawn.
struct Facts {
    std::array<std::optional<Look>, 2> shown; ///< looks of the pictures in the window, by side; none: no picture
    std::array<std::optional<engine::DrawnShadows>, 2> shadows;   ///< of the same
    std::map<std::string, std::uint32_t, std::less<>> thumbnails; ///< GL's names by built-in scene, on request
    bool isPreparing = false; ///< the next frame is the first of its kind, whose shaders may have to be compiled
    bool isSpreading = false; ///< the next frame computes anew how light spreads over surfaces
    std::optional<Progress> progress;   ///< of the picture
    std::optional<Progress> background; ///< of what is loaded meanwhile
    /// Whether the load goes before the picture, which it will replace: in the box over it, and with Esc.
    bool isLoadFirst() const { return background && (background->canCancel || !progress); }
    const std::optional<Progress>& told() const { return isLoadFirst() ? background : progress; } ///< by that box
    bool isCancelled = false;                        ///< the picture is left as far as it is drawn
    std::optional<engine::SpreadProgress> spreading; ///< of light that is spread slice by slice
    double ms = 0.0;                                 ///< of the latest frame, all sides
    double scale = 0.0;                              ///< its sides' share of the window's pixels
    glm::ivec2 sizePixels{0};
    std::optional<double> picturesPerSecond; ///< while something moves
    std::string renderer;                    ///< as the driver calls itself
    std::size_t targetBytes = 0;             ///< of the frames' render targets
    std::optional<graph::Plan> plan;
    std::optional<validation::LightOracleFigures> lights; ///< measured on request,
    std::string lightsOf;                                 ///< of this technique, culling and size,
    std::optional<Look> lightsLook;                       ///< with this look
    /// The largest count of the picture of a view that shows counts, by side, of both where they show the same view; an
    /// older picture's while another is drawn.
    struct MostCount {
        frame::DebugView view;
        float most;
    };
    std::array<std::optional<MostCount>, 2> mostCounts;
    /// That of a side, if its picture shows this view.
    std::optional<float> mostCountOf(int side, frame::DebugView view) const {
        const std::optional<MostCount>& most = mostCounts[std::size_t(side)];
        return most && most->view == view ? std::optional(most->most) : std::nullopt;
    }
    std::optional<Inspection> inspection;
    /// Where the picture shows the selected material.
    struct MaterialContours {
        int material = scenes::kNone;
        glm::ivec2 sizePixels{0}; ///< of the picture that they are in
        std::vector<Contour> contours;
    };
    std::optional<MaterialContours> materialOutline;
    /// A resource of the render graph, as the window is to show it.
    struct Resource {
        std::shared_ptr<const ResourceContents> contents;
        std::uint32_t picture = 0; ///< GL's name of a texture, its rows from the top; 0: it is no texture
        NumberRange range;         ///< from black to white in it
    };
    std::optional<Resource> resource;
    std::optional<validation::ErrorFigures> figures; ///< of the left picture against the right
    bool figuresAreOld = false;                      ///< newer ones are on their way
};

} // namespace tessera::viewer
