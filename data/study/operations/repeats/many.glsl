// 20 repetitions: drivers would not unroll a loop of so many alike.
#include <operation>

vec4 repeated(vec4 x) {
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    x = operate(x);
    return x;
}
