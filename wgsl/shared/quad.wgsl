// A cell of the cloth; a triangle has NO_CORNER as its fourth.
const NO_CORNER: u32 = 0xffffffffu;
