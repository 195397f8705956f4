// Fragment entry of lib/list_masks.glsl.
#define LIST_IN_COMPUTE 0
#include "lib/list_masks.glsl"

void main()
{
    maskTile(listItem());
}
