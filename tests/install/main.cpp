// A program outside the project: it knows Sahl only as installed.
#include <sahl/optics/snell.h>

#include <cstdio>

int main() {
    auto const d = sahl::refract({0.6, 0.0, 0.8}, {0.0, 0.0, -1.0}, 1.0, 1.5); // sin t = 0.6/1.5
    std::printf("%.17g %.17g %.17g\n", d->x, d->y, d->z);
    return d && d->x > 0.4 - 1e-15 && d->x < 0.4 + 1e-15 ? 0 : 1; // a few ulp of 0.4
}
