// Fragment entry of lib/lists/list_fill.glsl.
#define LIST_IN_COMPUTE 0
#include "lib/lists/list_fill.glsl"

void main()
{
    fillTile(listItem());
}
