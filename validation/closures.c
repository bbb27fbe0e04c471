/* closures.c -- see closures.h. */
#include "validation/closures.h"

#include <math.h>

double closure_clip(double solid_fraction, double solid_fraction_min) {
    return fmax(solid_fraction, solid_fraction_min);
}

/* -- permeability and settling ---------------------------------------------- */

double closure_conductivity(enum closure_law law, double solid_fraction,
                            double solid_fraction_min) {
    double rho = closure_clip(solid_fraction, solid_fraction_min);
    return pow(1 - rho, law) / (rho * rho);
}

double closure_face_conductivity(enum closure_law law, enum closure_face rule, double a, double b,
                                 double solid_fraction_min) {
    double rho_a = closure_clip(a, solid_fraction_min);
    double rho_b = closure_clip(b, solid_fraction_min);
    double k_a = closure_conductivity(law, rho_a, solid_fraction_min);
    double k_b = closure_conductivity(law, rho_b, solid_fraction_min);
    if (rule == CLOSURE_HARMONIC)
        return 2 * k_a * k_b / (k_a + k_b);
    if (rule == CLOSURE_OF_MEAN)
        return closure_conductivity(law, (rho_a + rho_b) / 2, solid_fraction_min);
    return (k_a + k_b) / 2;
}

/* Closed box, steady, homogeneous: Eq. 8 integrated from the bottom gives
 * (1/Pe) K dp/dz = u, where u = v rho/rho' is the velocity that the gas sees, and
 * a grain that does not accelerate needs -(1/Pe) dp/dz = rho' (Eq. 11).  Hence
 * v = K(rho') rho'^2 / rho, which is (1-rho')^m / rho. */
double closure_settling_speed(enum closure_law law, double solid_fraction,
                              double solid_fraction_min) {
    double rho = closure_clip(solid_fraction, solid_fraction_min);
    return pow(1 - rho, law) / solid_fraction;
}

double closure_settling_speed_eq20(double solid_fraction) {
    double phi = 1 - solid_fraction;
    return phi * phi * phi / (solid_fraction * (1 + solid_fraction));
}

/* -- relaxation of the pressure --------------------------------------------- */

double closure_diffusivity(enum closure_law law, double solid_fraction, double solid_fraction_min,
                           double peclet) {
    double rho = closure_clip(solid_fraction, solid_fraction_min);
    return closure_conductivity(law, rho, solid_fraction_min) / ((1 - rho) * peclet);
}

double closure_mode_square(double mode_x, double mode_y, double width_l, double height_l) {
    double kx = M_PI * mode_x / width_l, ky = M_PI * mode_y / height_l;
    return kx * kx + ky * ky;
}

double closure_mode_square_lattice(double mode_x, double mode_y, double width_l, double height_l) {
    double sx = 2 * sin(M_PI * mode_x / (2 * width_l));
    double sy = 2 * sin(M_PI * mode_y / (2 * height_l));
    return sx * sx + sy * sy;
}

/* -- hard discs ------------------------------------------------------------- */

enum { VIRIAL_TERMS = 10 };

/* B_n/B_2^(n-1), n = 1 .. 10: B_3/B_2^2 = 4/3 - sqrt(3)/pi,
 * B_4/B_2^3 = 2 - 9 sqrt(3)/(2 pi) + 10/pi^2; B_5 .. B_10 from the
 * table in Clisby & McCoy, J. Stat. Phys. 122, 15 (2006), whose uncertainties
 * change Z by 5e-5 at area fraction .6. */
static const double VIRIAL[VIRIAL_TERMS] = {
    1,         1,         0.78200443791154, 0.53223180702531, 0.33355604,
    0.1988425, 0.1148728, 0.0649930,        0.0362193,        0.0199537};

/* The ten-term series, cut off, is 3 % low at area fraction .6.  Multiplied by
 * (1-eta)^2 its coefficients r_n fall off fast: Z = sum r_n eta^n / (1-eta)^2.
 * Pade approximants of the same ten terms differ from it by 2e-4 at .6. */
static void rescaled_virial(double r[VIRIAL_TERMS]) {
    double c[VIRIAL_TERMS]; /* coefficients of the powers of eta: B_2 n = 2 eta */
    for (int n = 0; n < VIRIAL_TERMS; n++)
        c[n] = VIRIAL[n] * pow(2, n);
    for (int n = 0; n < VIRIAL_TERMS; n++)
        r[n] = c[n] - (n >= 1 ? 2 * c[n - 1] : 0) + (n >= 2 ? c[n - 2] : 0);
}

double closure_disc_compressibility(double area_fraction) {
    double r[VIRIAL_TERMS], sum = 0;
    rescaled_virial(r);
    for (int n = VIRIAL_TERMS; n-- > 0;)
        sum = sum * area_fraction + r[n];
    return sum / ((1 - area_fraction) * (1 - area_fraction));
}

double closure_disc_compressibility_henderson(double area_fraction) {
    double void_fraction = 1 - area_fraction;
    return (1 + area_fraction * area_fraction / 8) / (void_fraction * void_fraction);
}

double closure_disc_stiffness(double area_fraction) {
    double r[VIRIAL_TERMS], sum = 0, slope = 0;
    rescaled_virial(r);
    for (int n = VIRIAL_TERMS; n-- > 0;) {
        slope = slope * area_fraction + sum;
        sum = sum * area_fraction + r[n];
    }
    return area_fraction * (slope / sum + 2 / (1 - area_fraction));
}

/* -- the lattice ------------------------------------------------------------ */

double closure_site_volume(size_t i, size_t j, size_t nx, size_t ny) {
    double across = i == 0 || i == nx - 1 ? 0.5 : 1;
    double up = j == 0 || j == ny - 1 ? 0.5 : 1;
    return across * up;
}

/* Lower site of the cell that holds x; the last cell also holds its upper end. */
static size_t cell_of(double x, size_t sites) {
    size_t i = x > 0 ? (size_t)x : 0;
    return i > sites - 2 ? sites - 2 : i;
}

struct closure_halo closure_halo_at(double x, double y, size_t nx, size_t ny) {
    size_t i = cell_of(x, nx), j = cell_of(y, ny);
    struct closure_halo h;
    for (size_t k = 0; k < 4; k++) {
        size_t site_i = i + k % 2, site_j = j + k / 2;
        h.site[k] = site_j * nx + site_i;
        h.weight[k] = (1 - fabs(x - (double)site_i)) * (1 - fabs(y - (double)site_j));
    }
    return h;
}

/* Mean of the face differences beside entry k of a line of n values, `stride` apart. */
static double line_gradient(const double *value, size_t k, size_t n, size_t stride) {
    double sum = 0;
    int faces = 0;
    if (k > 0) {
        sum += value[k * stride] - value[(k - 1) * stride];
        faces++;
    }
    if (k < n - 1) {
        sum += value[(k + 1) * stride] - value[k * stride];
        faces++;
    }
    return sum / faces;
}

void closure_gradient(const double *value, size_t i, size_t j, size_t nx, size_t ny,
                      double gradient[2]) {
    gradient[0] = line_gradient(value + j * nx, i, nx, 1);
    gradient[1] = line_gradient(value + i, j, ny, nx);
}

double closure_outflow(const double *u, size_t i, size_t j, size_t nx, size_t ny) {
    size_t k = j * nx + i;
    double along_x = j == 0 || j == ny - 1 ? 0.5 : 1; /* length of the faces across x (l) */
    double along_y = i == 0 || i == nx - 1 ? 0.5 : 1;
    double sum = 0;
    if (i < nx - 1)
        sum += along_x * (u[2 * k] + u[2 * (k + 1)]) / 2;
    if (i > 0)
        sum -= along_x * (u[2 * k] + u[2 * (k - 1)]) / 2;
    if (j < ny - 1)
        sum += along_y * (u[2 * k + 1] + u[2 * (k + nx) + 1]) / 2;
    if (j > 0)
        sum -= along_y * (u[2 * k + 1] + u[2 * (k - nx) + 1]) / 2;
    return sum;
}
