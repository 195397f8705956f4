// Compute entry of lib/lists/list_fill.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/lists/list_fill.glsl"

void main()
{
    fillTile(listItem());
}
