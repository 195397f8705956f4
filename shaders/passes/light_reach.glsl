// Entry point of lib/lists/list_reach.glsl.
#include "lib/lists/list_reach.glsl"

void main()
{
    findReach(listItem());
}
