// Entry point of lib/lists/list_fill.glsl that counts cells before its rounds.
#include "lib/lists/list_fill.glsl"

void main()
{
    sizeTile(listItem());
}
