// CGAL's decisions for rows of cases. A line is made of a point and a vector, which is exact in both kernels; a ray of two
// points, the second of which the kernel with inexact constructions rounds, as it rounds the square of the radius.

#include <cmath>
#include <cstddef>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace {

struct Case {
    double origin[3], direction[3], center[3], radius;
};

// CGAL must not be asked about anything else.
bool is_valid(const Case &c) {
    bool finite = std::isfinite(c.radius), moves = false;
    for (int i = 0; i < 3; ++i) {
        finite = finite && std::isfinite(c.origin[i]) && std::isfinite(c.direction[i]) && std::isfinite(c.center[i]);
        moves = moves || c.direction[i] != 0;
    }
    return finite && moves && c.radius >= 0;
}

template <class Kernel, class Path> void decide(const Case *cases, std::size_t count, bool *answers) {
    typedef typename Kernel::Point_3 Point;
    for (std::size_t i = 0; i < count; ++i) {
        const Case &c = cases[i];
        if (!is_valid(c)) {
            answers[i] = false;
            continue;
        }
        const typename Kernel::FT radius(c.radius);
        const typename Kernel::Sphere_3 sphere(Point(c.center[0], c.center[1], c.center[2]), radius * radius);
        const typename Kernel::Vector_3 direction(c.direction[0], c.direction[1], c.direction[2]);
        const Path path(Point(c.origin[0], c.origin[1], c.origin[2]), direction);
        answers[i] = CGAL::do_intersect(sphere, path);
    }
}

typedef CGAL::Exact_predicates_inexact_constructions_kernel Inexact;
typedef CGAL::Exact_predicates_exact_constructions_kernel Exact;

} // namespace

extern "C" {

void eyeray_cgal_line_inexact(const Case *cases, std::size_t count, bool *answers) {
    decide<Inexact, Inexact::Line_3>(cases, count, answers);
}

void eyeray_cgal_ray_inexact(const Case *cases, std::size_t count, bool *answers) {
    decide<Inexact, Inexact::Ray_3>(cases, count, answers);
}

void eyeray_cgal_line_exact(const Case *cases, std::size_t count, bool *answers) {
    decide<Exact, Exact::Line_3>(cases, count, answers);
}

void eyeray_cgal_ray_exact(const Case *cases, std::size_t count, bool *answers) {
    decide<Exact, Exact::Ray_3>(cases, count, answers);
}
}
