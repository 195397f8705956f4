// Entry point of lib/lists/list_masks.glsl, for tiles.
#include "lib/lists/list_masks.glsl"

void main()
{
    maskTile(listItem());
}
