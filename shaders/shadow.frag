// Depth alone: nothing to colour.
#version 460
void main() {}
