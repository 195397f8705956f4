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

/// Progress of a long operation, for the box over the image.
struct Progress {
    std::string text;            ///< "Drawing at scale 0.5"
    std::optional<double> share; ///< fraction done; none: unknown
    bool canCancel = false;      ///< by Esc
    bool operator==(const Progress&) const = default;
};

/// Results of drawn frames, for display in panels.
struct Facts {
    std::array<std::optional<Look>, 2> shown; ///< looks of the displayed images, by side; none: no image
    std::array<std::optional<engine::DrawnShadows>, 2> shadows;   ///< of the same images
    std::map<std::string, std::uint32_t, std::less<>> thumbnails; ///< GL texture names by built-in scene, on request
    bool isPreparing = false;           ///< the next frame is the first of its kind, and may compile shaders
    bool isDiffusing = false;           ///< the next frame recomputes the diffused irradiance
    std::optional<Progress> progress;   ///< of the image
    std::optional<Progress> background; ///< of a load in the background
    /// Whether the load takes precedence over the image, which it will replace, in the progress box and for Esc.
    bool isLoadFirst() const { return background && (background->canCancel || !progress); }
    const std::optional<Progress>& shownProgress() const {
        return isLoadFirst() ? background : progress;
    }                                                   ///< in that box
    bool isCancelled = false;                           ///< the image stays as far as it is drawn
    std::optional<engine::DiffusionProgress> diffusion; ///< of irradiance that is diffused in slices
    double ms = 0.0;                                    ///< of the latest frame, all sides
    double scale = 0.0;                                 ///< its sides relative to those of the window, in pixels
    glm::ivec2 sizePixels{0};
    std::optional<double> picturesPerSecond; ///< while something moves
    std::string renderer;                    ///< the driver's name
    std::size_t targetBytes = 0;             ///< of the frames' render targets
    std::optional<graph::Plan> plan;
    std::optional<validation::LightOracleFigures> lights; ///< measured on request,
    std::string lightsOf;                                 ///< with this technique, culling and size,
    std::optional<Look> lightsLook;                       ///< and this look
    /// The largest count in the image of a view of counts, by side; of both sides if they show the same view. While
    /// another image is drawn, the previous one's.
    struct MostCount {
        frame::DebugView view;
        float most;
    };
    std::array<std::optional<MostCount>, 2> mostCounts;
    /// The largest count of a side if its image shows this view.
    std::optional<float> mostCountOf(int side, frame::DebugView view) const {
        const std::optional<MostCount>& most = mostCounts[std::size_t(side)];
        return most && most->view == view ? std::optional(most->most) : std::nullopt;
    }
    std::optional<Inspection> inspection;
    /// The outline of the selected material in the image.
    struct MaterialContours {
        int material = scenes::kNone;
        glm::ivec2 sizePixels{0}; ///< of the image in which they were found
        std::vector<Contour> contours;
    };
    std::optional<MaterialContours> materialOutline;
    /// A resource of the render graph, as displayed in the window.
    struct Resource {
        std::shared_ptr<const ResourceContents> contents;
        std::uint32_t picture = 0; ///< GL texture name, rows from the top; 0: not a texture
        NumberRange range;         ///< displayed as black to white
    };
    std::optional<Resource> resource;
    std::optional<validation::ErrorFigures> figures; ///< of the left image against the right
    bool figuresAreOld = false;                      ///< newer ones are being measured
};

} // namespace tessera::viewer
