#include "*.h"
#include <stdio.h>
int main(void){ printf("self %d\n", *_self_test()); return 0; }
