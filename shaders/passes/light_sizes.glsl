// Entry of lib/lists/list_fill.glsl, before its rounds.
#include "lib/lists/list_fill.glsl"

void main()
{
    sizeTile(listItem());
}
