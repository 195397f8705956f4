// Entry point of lib/lists/list_masks.glsl, for depth bins.
#include "lib/lists/list_masks.glsl"

void main()
{
    maskBin(listItem());
}
