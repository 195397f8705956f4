#include "validation/compare/RangeTruncation.h"

#include "engine/Rendering.h"

namespace tessera::validation {

RangeTruncation rangeTruncation(engine::Renderer& renderer, engine::Technique technique,
                                frame::FrameSettings settings) {
    settings.view = frame::DebugView::Final;
    const double tolerance = settings.rangeTolerance;
    const Picture truncated = toPicture(renderer.render(technique, settings));
    settings.rangeTolerance = 0.0;
    const Picture whole = toPicture(renderer.render(technique, settings));
    return {tolerance, std::string(infoOf(technique).name), errorFigures(truncated, whole)};
}

} // namespace tessera::validation
