// Makes the program take a processor without AVX2 for granted: kernels of several versions (WILT_CLONES) ask
// libgcc at start-up what there is, and these stand in for libgcc's answers. Debian 12's valgrind lacks an
// instruction of the AVX2 versions; and so the counts belong to no class of processor.
extern "C" {

struct {
  unsigned vendor, type, subtype, features[1];
} __cpu_model = {};
unsigned __cpu_features2[8] = {};

int __cpu_indicator_init() {
  return 0;
}
}
