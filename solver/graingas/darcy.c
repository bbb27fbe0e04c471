#include "solver/graingas/darcy.h"

double darcy_drag_rate(enum darcy_law law, double rho, double froude) {
    return 1 / (froude * rho * darcy_coefficient(law, rho));
}

double darcy_face(enum face_rule rule, enum darcy_law law, double a, double b, double rho_a,
                  double rho_b) {
    switch (rule) {
    case FACE_ARITHMETIC:
        return 0.5 * (a + b);
    case FACE_HARMONIC:
        return 2 * a * b / (a + b);
    case FACE_OF_MEAN:
        return darcy_coefficient(law, 0.5 * (rho_a + rho_b));
    }
    return 0;
}
