// Entry point of lib/lists/list_depths.glsl.
#include "lib/lists/list_depths.glsl"

void main()
{
    findDepths(listItem());
}
