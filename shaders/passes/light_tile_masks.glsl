// Entry of lib/lists/list_masks.glsl.
#include "lib/lists/list_masks.glsl"

void main()
{
    maskTile(listItem());
}
