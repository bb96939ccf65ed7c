// The sum of the lights' terms with what each addition rounds away carried along (L7).
//
// Model:  sum of t_i.
// Range:  terms not negative, so the relative error is about 2^-23 for any number of terms.
// Source: Kahan, Further Remarks on Reducing Truncation Errors, CACM 8 (1965); Higham, Accuracy and Stability
//         of Numerical Algorithms, 4.3.
// Edges:  `precise`, since compilers fold (x + y) - x to y.

/// A sum under way, and by how much it is too large.
struct LightSum {
    vec3 total;
    vec3 excess;
};

/// The sum of no terms.
LightSum emptySum() { return LightSum(vec3(0.0), vec3(0.0)); }

/// Adds a term.
void addTerm(inout LightSum sum, vec3 term) {
    precise vec3 owed = term - sum.excess;
    precise vec3 total = sum.total + owed;
    precise vec3 added = total - sum.total;
    precise vec3 excess = added - owed;
    sum.excess = excess;
    sum.total = total;
}

/// The sum of the terms added so far.
vec3 totalOf(LightSum sum) { return sum.total; }
