// The sum of the lights' terms, in the order of the lights (L7).
//
// Model:  sum of t_i.
// Range:  terms not negative, so the relative error of k terms is at most (k - 1) 2^-24.
// Source: Higham, Accuracy and Stability of Numerical Algorithms, 4.2.
// Edges:  no terms give exactly 0; the order of the lights may change the last digits.

/// A sum under way.
struct LightSum {
    vec3 total;
};

/// The sum of no terms.
LightSum emptySum() { return LightSum(vec3(0.0)); }

/// Adds a term.
void addTerm(inout LightSum sum, vec3 term) { sum.total += term; }

/// The sum of the terms added so far.
vec3 totalOf(LightSum sum) { return sum.total; }
