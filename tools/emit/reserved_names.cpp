// What no name of a generated header may be: keywords, and what other people's headers make macros.
#include "emit/reserved_names.hpp"

#include <initializer_list>
#include <set>

#include "core/text.hpp"
#include "emit/global_names.hpp"

namespace gobo {
namespace {

/// Keywords of C++17 and C++20 and their alternative tokens.
constexpr std::string_view kKeywords =
    "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t char8_t "
    "class co_await co_return co_yield compl concept const const_cast consteval constexpr constinit "
    "continue decltype default delete do double dynamic_cast else enum explicit export extern false float "
    "for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq "
    "private protected public register reinterpret_cast requires return short signed sizeof static "
    "static_assert static_cast struct switch template this thread_local throw true try typedef typeid "
    "typename union unsigned using virtual void volatile wchar_t while xor xor_eq";

/// Macros of <windows.h> that stand for something without parentheses behind them.
constexpr std::string_view kWindowsMacros =
    "ABSOLUTE ALTERNATE CALLBACK CONST CreateFont CreateWindow DELETE DIFFERENCE DOMAIN DrawText ERROR FALSE "
    "FAR "
    "GetObject IGNORE IN INFINITE LoadImage NEAR NO_ERROR OPAQUE OPTIONAL OUT OVERFLOW RELATIVE STRICT THIS "
    "TRANSPARENT TRUE UNDERFLOW VOID WINAPI WINDING cdecl far hyper interface near pascal small";

/// Macros of <X11/Xlib.h> and <X11/X.h>, but those that end in Mask or begin with GX, XN and other prefixes
/// that nobody else uses.
constexpr std::string_view kXlibMacros =
    "Above AllPlanes AllTemporary AllocAll AllocNone AllowExposures AlreadyGrabbed Always AnyButton AnyKey "
    "AnyModifier AnyPropertyType ArcChord ArcPieSlice AsyncBoth AsyncKeyboard AsyncPointer "
    "AutoRepeatModeDefault AutoRepeatModeOff AutoRepeatModeOn BadAccess BadAlloc BadAtom BadColor BadCursor "
    "BadDrawable BadFont BadGC BadIDChoice BadImplementation BadLength BadMatch BadName BadPixmap "
    "BadRequest BadValue BadWindow Below BitmapBitOrder BitmapPad BitmapUnit BlackPixel BlackPixelOfScreen "
    "Bool BottomIf Button1 Button2 Button3 Button4 Button5 ButtonPress ButtonRelease CapButt CapNotLast "
    "CapProjecting CapRound CellsOfScreen CenterGravity CirculateNotify CirculateRequest ClientMessage "
    "ClipByChildren ColormapInstalled ColormapNotify ColormapUninstalled Complex ConfigureNotify "
    "ConfigureRequest ConnectionNumber ControlMapIndex Convex CoordModeOrigin CoordModePrevious "
    "CopyFromParent CreateNotify CurrentTime CursorShape DefaultBlanking DefaultColormap "
    "DefaultColormapOfScreen DefaultDepth DefaultDepthOfScreen DefaultExposures DefaultGC DefaultGCOfScreen "
    "DefaultRootWindow DefaultScreen DefaultScreenOfDisplay DefaultVisual DefaultVisualOfScreen DestroyAll "
    "DestroyNotify DirectColor DisableAccess DisableScreenInterval DisableScreenSaver DisplayCells "
    "DisplayHeight DisplayHeightMM DisplayOfScreen DisplayPlanes DisplayString DisplayWidth DisplayWidthMM "
    "DoBlue DoGreen DoRed DoesBackingStore DoesSaveUnders DontAllowExposures DontPreferBlanking EastGravity "
    "EnableAccess EnterNotify EvenOddRule EventMaskOfScreen Expose FUNCPROTO False FamilyChaos FamilyDECnet "
    "FamilyInternet FamilyInternet6 FamilyServerInterpreted FillOpaqueStippled FillSolid FillStippled "
    "FillTiled FirstExtensionError FocusIn FocusOut FontChange FontLeftToRight FontRightToLeft "
    "ForgetGravity GenericEvent GrabFrozen GrabInvalidTime GrabModeAsync GrabModeSync GrabNotViewable "
    "GrabSuccess GraphicsExpose GravityNotify GrayScale HeightMMOfScreen HeightOfScreen HostDelete "
    "HostInsert ImageByteOrder IncludeInferiors InputFocus InputOnly InputOutput IsUnmapped IsUnviewable "
    "IsViewable JoinBevel JoinMiter JoinRound KBAutoRepeatMode KBBellDuration KBBellPercent KBBellPitch "
    "KBKey KBKeyClickPercent KBLed KBLedMode KeyPress KeyRelease KeymapNotify LASTEvent LSBFirst "
    "LastExtensionError LastKnownRequestProcessed LeaveNotify LedModeOff LedModeOn LineDoubleDash "
    "LineOnOffDash LineSolid LockMapIndex LowerHighest MSBFirst MapNotify MapRequest MappingBusy "
    "MappingFailed MappingKeyboard MappingModifier MappingNotify MappingPointer MappingSuccess "
    "MaxCmapsOfScreen MinCmapsOfScreen Mod1MapIndex Mod2MapIndex Mod3MapIndex Mod4MapIndex Mod5MapIndex "
    "MotionNotify NARROWPROTO NeedFunctionPrototypes NeedNestedPrototypes NeedVarargsPrototypes "
    "NeedWidePrototypes NextRequest NoExpose NoSymbol Nonconvex None NorthEastGravity NorthGravity "
    "NorthWestGravity NotUseful NotifyAncestor NotifyDetailNone NotifyGrab NotifyHint NotifyInferior "
    "NotifyNonlinear NotifyNonlinearVirtual NotifyNormal NotifyPointer NotifyPointerRoot NotifyUngrab "
    "NotifyVirtual NotifyWhileGrabbed Opposite ParentRelative PlaceOnBottom PlaceOnTop PlanesOfScreen "
    "PointerRoot PointerWindow PreferBlanking PropModeAppend PropModePrepend PropModeReplace PropertyDelete "
    "PropertyNewValue PropertyNotify ProtocolRevision ProtocolVersion PseudoColor QLength QueuedAfterFlush "
    "QueuedAfterReading QueuedAlready RaiseLowest ReparentNotify ReplayKeyboard ReplayPointer ResizeRequest "
    "RetainPermanent RetainTemporary RevertToNone RevertToParent RevertToPointerRoot RootWindow "
    "RootWindowOfScreen ScreenCount ScreenOfDisplay ScreenSaverActive ScreenSaverReset SelectionClear "
    "SelectionNotify SelectionRequest ServerVendor SetModeDelete SetModeInsert ShiftMapIndex "
    "SouthEastGravity SouthGravity SouthWestGravity StaticColor StaticGravity StaticGray Status "
    "StippleShape Success SyncBoth SyncKeyboard SyncPointer TileShape TopIf True TrueColor UnmapGravity "
    "UnmapNotify Unsorted VendorRelease VisibilityFullyObscured VisibilityNotify "
    "VisibilityPartiallyObscured VisibilityUnobscured WestGravity WhenMapped WhitePixel WhitePixelOfScreen "
    "WidthMMOfScreen WidthOfScreen WindingRule XAllocID XBufferOverflow XYBitmap XYPixmap "
    "XlibSpecificationRelease YSorted YXBanded YXSorted ZPixmap linux uni";

/// Macros of g++ in GNU mode and of the headers of the C and C++ standard library (glibc 2.36, libstdc++ 12).
constexpr std::string_view kStandardMacros =
    "i386 linux major minor unix "
    "AIO_PRIO_DELTA_MAX ATOMIC_BOOL_LOCK_FREE ATOMIC_CHAR16_T_LOCK_FREE ATOMIC_CHAR32_T_LOCK_FREE "
    "ATOMIC_CHAR_LOCK_FREE ATOMIC_FLAG_INIT ATOMIC_INT_LOCK_FREE ATOMIC_LLONG_LOCK_FREE "
    "ATOMIC_LONG_LOCK_FREE ATOMIC_POINTER_LOCK_FREE ATOMIC_SHORT_LOCK_FREE ATOMIC_VAR_INIT "
    "ATOMIC_WCHAR_T_LOCK_FREE BC_BASE_MAX BC_DIM_MAX BC_SCALE_MAX BC_STRING_MAX BIG_ENDIAN BOOL_MAX "
    "BOOL_WIDTH BUFSIZ BYTE_ORDER CHARCLASS_NAME_MAX CHAR_BIT CHAR_MAX CHAR_MIN CHAR_WIDTH CLOCKS_PER_SEC "
    "CLOCK_BOOTTIME CLOCK_BOOTTIME_ALARM CLOCK_MONOTONIC CLOCK_MONOTONIC_COARSE CLOCK_MONOTONIC_RAW "
    "CLOCK_PROCESS_CPUTIME_ID CLOCK_REALTIME CLOCK_REALTIME_ALARM CLOCK_REALTIME_COARSE CLOCK_TAI "
    "CLOCK_THREAD_CPUTIME_ID COLL_WEIGHTS_MAX CSIGNAL DBL_DECIMAL_DIG DBL_DIG DBL_EPSILON DBL_HAS_SUBNORM "
    "DBL_MANT_DIG DBL_MAX DBL_MAX_10_EXP DBL_MAX_EXP DBL_MIN DBL_MIN_10_EXP DBL_MIN_EXP DBL_TRUE_MIN "
    "DECIMAL_DIG DELAYTIMER_MAX E2BIG EACCES EADDRINUSE EADDRNOTAVAIL EADV EAFNOSUPPORT EAGAIN EALREADY "
    "EBADE EBADF EBADFD EBADMSG EBADR EBADRQC EBADSLT EBFONT EBUSY ECANCELED ECHILD ECHRNG ECOMM "
    "ECONNABORTED ECONNREFUSED ECONNRESET EDEADLK EDEADLOCK EDESTADDRREQ EDOM EDOTDOT EDQUOT EEXIST EFAULT "
    "EFBIG EHOSTDOWN EHOSTUNREACH EHWPOISON EIDRM EILSEQ EINPROGRESS EINTR EINVAL EIO EISCONN EISDIR EISNAM "
    "EKEYEXPIRED EKEYREJECTED EKEYREVOKED EL2HLT EL2NSYNC EL3HLT EL3RST ELIBACC ELIBBAD ELIBEXEC ELIBMAX "
    "ELIBSCN ELNRNG ELOOP EMEDIUMTYPE EMFILE EMLINK EMSGSIZE EMULTIHOP ENAMETOOLONG ENAVAIL ENETDOWN "
    "ENETRESET ENETUNREACH ENFILE ENOANO ENOBUFS ENOCSI ENODATA ENODEV ENOENT ENOEXEC ENOKEY ENOLCK ENOLINK "
    "ENOMEDIUM ENOMEM ENOMSG ENONET ENOPKG ENOPROTOOPT ENOSPC ENOSR ENOSTR ENOSYS ENOTBLK ENOTCONN ENOTDIR "
    "ENOTEMPTY ENOTNAM ENOTRECOVERABLE ENOTSOCK ENOTSUP ENOTTY ENOTUNIQ ENXIO EOF EOPNOTSUPP EOVERFLOW "
    "EOWNERDEAD EPERM EPFNOSUPPORT EPIPE EPROTO EPROTONOSUPPORT EPROTOTYPE ERANGE EREMCHG EREMOTE EREMOTEIO "
    "ERESTART ERFKILL EROFS ESHUTDOWN ESOCKTNOSUPPORT ESPIPE ESRCH ESRMNT ESTALE ESTRPIPE ETIME ETIMEDOUT "
    "ETOOMANYREFS ETXTBSY EUCLEAN EUNATCH EUSERS EWOULDBLOCK EXDEV EXFULL EXIT_FAILURE EXIT_SUCCESS "
    "EXPR_NEST_MAX FE_ALL_EXCEPT FE_DFL_ENV FE_DFL_MODE FE_DIVBYZERO FE_DOWNWARD FE_INEXACT FE_INVALID "
    "FE_NOMASK_ENV FE_OVERFLOW FE_TONEAREST FE_TOWARDZERO FE_UNDERFLOW FE_UPWARD FILENAME_MAX "
    "FLT_DECIMAL_DIG FLT_DIG FLT_EPSILON FLT_EVAL_METHOD FLT_HAS_SUBNORM FLT_MANT_DIG FLT_MAX "
    "FLT_MAX_10_EXP FLT_MAX_EXP FLT_MIN FLT_MIN_10_EXP FLT_MIN_EXP FLT_RADIX FLT_ROUNDS FLT_TRUE_MIN "
    "FOPEN_MAX FP_ILOGB0 FP_ILOGBNAN FP_INFINITE FP_LLOGB0 FP_LLOGBNAN FP_NAN FP_NORMAL FP_SUBNORMAL "
    "FP_XSTATE_MAGIC1 FP_XSTATE_MAGIC2 FP_XSTATE_MAGIC2_SIZE FP_ZERO HOST_NAME_MAX HUGE_VAL HUGE_VALF "
    "HUGE_VALL INFINITY INT16_C INT16_MAX INT16_MIN INT16_WIDTH INT32_C INT32_MAX INT32_MIN INT32_WIDTH "
    "INT64_C INT64_MAX INT64_MIN INT64_WIDTH INT8_C INT8_MAX INT8_MIN INT8_WIDTH INTMAX_C INTMAX_MAX "
    "INTMAX_MIN INTMAX_WIDTH INTPTR_MAX INTPTR_MIN INTPTR_WIDTH INT_FAST16_MAX INT_FAST16_MIN "
    "INT_FAST16_WIDTH INT_FAST32_MAX INT_FAST32_MIN INT_FAST32_WIDTH INT_FAST64_MAX INT_FAST64_MIN "
    "INT_FAST64_WIDTH INT_FAST8_MAX INT_FAST8_MIN INT_FAST8_WIDTH INT_LEAST16_MAX INT_LEAST16_MIN "
    "INT_LEAST16_WIDTH INT_LEAST32_MAX INT_LEAST32_MIN INT_LEAST32_WIDTH INT_LEAST64_MAX INT_LEAST64_MIN "
    "INT_LEAST64_WIDTH INT_LEAST8_MAX INT_LEAST8_MIN INT_LEAST8_WIDTH INT_MAX INT_MIN INT_WIDTH IOV_MAX "
    "LC_ADDRESS LC_ADDRESS_MASK LC_ALL LC_ALL_MASK LC_COLLATE LC_COLLATE_MASK LC_CTYPE LC_CTYPE_MASK "
    "LC_GLOBAL_LOCALE LC_IDENTIFICATION LC_IDENTIFICATION_MASK LC_MEASUREMENT LC_MEASUREMENT_MASK "
    "LC_MESSAGES LC_MESSAGES_MASK LC_MONETARY LC_MONETARY_MASK LC_NAME LC_NAME_MASK LC_NUMERIC "
    "LC_NUMERIC_MASK LC_PAPER LC_PAPER_MASK LC_TELEPHONE LC_TELEPHONE_MASK LC_TIME LC_TIME_MASK "
    "LDBL_DECIMAL_DIG LDBL_DIG LDBL_EPSILON LDBL_HAS_SUBNORM LDBL_MANT_DIG LDBL_MAX LDBL_MAX_10_EXP "
    "LDBL_MAX_EXP LDBL_MIN LDBL_MIN_10_EXP LDBL_MIN_EXP LDBL_TRUE_MIN LINE_MAX LITTLE_ENDIAN LLONG_MAX "
    "LLONG_MIN LLONG_WIDTH LOGIN_NAME_MAX LONG_BIT LONG_LONG_MAX LONG_LONG_MIN LONG_MAX LONG_MIN LONG_WIDTH "
    "L_tmpnam MATH_ERREXCEPT MATH_ERRNO MAXFLOAT MAX_CANON MAX_INPUT MB_CUR_MAX MB_LEN_MAX MINSIGSTKSZ "
    "MQ_PRIO_MAX M_1_PI M_1_PIf M_1_PIf128 M_1_PIf32 M_1_PIf32x M_1_PIf64 M_1_PIf64x M_1_PIl M_2_PI M_2_PIf "
    "M_2_PIf128 M_2_PIf32 M_2_PIf32x M_2_PIf64 M_2_PIf64x M_2_PIl M_2_SQRTPI M_2_SQRTPIf M_2_SQRTPIf128 "
    "M_2_SQRTPIf32 M_2_SQRTPIf32x M_2_SQRTPIf64 M_2_SQRTPIf64x M_2_SQRTPIl M_E M_Ef M_Ef128 M_Ef32 M_Ef32x "
    "M_Ef64 M_Ef64x M_El M_LN10 M_LN10f M_LN10f128 M_LN10f32 M_LN10f32x M_LN10f64 M_LN10f64x M_LN10l M_LN2 "
    "M_LN2f M_LN2f128 M_LN2f32 M_LN2f32x M_LN2f64 M_LN2f64x M_LN2l M_LOG10E M_LOG10Ef M_LOG10Ef128 "
    "M_LOG10Ef32 M_LOG10Ef32x M_LOG10Ef64 M_LOG10Ef64x M_LOG10El M_LOG2E M_LOG2Ef M_LOG2Ef128 M_LOG2Ef32 "
    "M_LOG2Ef32x M_LOG2Ef64 M_LOG2Ef64x M_LOG2El M_PI M_PI_2 M_PI_2f M_PI_2f128 M_PI_2f32 M_PI_2f32x "
    "M_PI_2f64 M_PI_2f64x M_PI_2l M_PI_4 M_PI_4f M_PI_4f128 M_PI_4f32 M_PI_4f32x M_PI_4f64 M_PI_4f64x "
    "M_PI_4l M_PIf M_PIf128 M_PIf32 M_PIf32x M_PIf64 M_PIf64x M_PIl M_SQRT1_2 M_SQRT1_2f M_SQRT1_2f128 "
    "M_SQRT1_2f32 M_SQRT1_2f32x M_SQRT1_2f64 M_SQRT1_2f64x M_SQRT1_2l M_SQRT2 M_SQRT2f M_SQRT2f128 "
    "M_SQRT2f32 M_SQRT2f32x M_SQRT2f64 M_SQRT2f64x M_SQRT2l NAME_MAX NAN NGROUPS_MAX NSIG NULL NZERO "
    "PATH_MAX PDP_ENDIAN PIPE_BUF PRIX16 PRIX32 PRIX64 PRIX8 PRIXFAST16 PRIXFAST32 PRIXFAST64 PRIXFAST8 "
    "PRIXLEAST16 PRIXLEAST32 PRIXLEAST64 PRIXLEAST8 PRIXMAX PRIXPTR PRId16 PRId32 PRId64 PRId8 PRIdFAST16 "
    "PRIdFAST32 PRIdFAST64 PRIdFAST8 PRIdLEAST16 PRIdLEAST32 PRIdLEAST64 PRIdLEAST8 PRIdMAX PRIdPTR PRIi16 "
    "PRIi32 PRIi64 PRIi8 PRIiFAST16 PRIiFAST32 PRIiFAST64 PRIiFAST8 PRIiLEAST16 PRIiLEAST32 PRIiLEAST64 "
    "PRIiLEAST8 PRIiMAX PRIiPTR PRIo16 PRIo32 PRIo64 PRIo8 PRIoFAST16 PRIoFAST32 PRIoFAST64 PRIoFAST8 "
    "PRIoLEAST16 PRIoLEAST32 PRIoLEAST64 PRIoLEAST8 PRIoMAX PRIoPTR PRIu16 PRIu32 PRIu64 PRIu8 PRIuFAST16 "
    "PRIuFAST32 PRIuFAST64 PRIuFAST8 PRIuLEAST16 PRIuLEAST32 PRIuLEAST64 PRIuLEAST8 PRIuMAX PRIuPTR PRIx16 "
    "PRIx32 PRIx64 PRIx8 PRIxFAST16 PRIxFAST32 PRIxFAST64 PRIxFAST8 PRIxLEAST16 PRIxLEAST32 PRIxLEAST64 "
    "PRIxLEAST8 PRIxMAX PRIxPTR PTRDIFF_MAX PTRDIFF_MIN PTRDIFF_WIDTH RAND_MAX RE_DUP_MAX RTSIG_MAX R_OK "
    "SCHAR_MAX SCHAR_MIN SCHAR_WIDTH SCHED_BATCH SCHED_DEADLINE SCHED_FIFO SCHED_IDLE SCHED_ISO SCHED_OTHER "
    "SCHED_RESET_ON_FORK SCHED_RR SCNd16 SCNd32 SCNd64 SCNd8 SCNdFAST16 SCNdFAST32 SCNdFAST64 SCNdFAST8 "
    "SCNdLEAST16 SCNdLEAST32 SCNdLEAST64 SCNdLEAST8 SCNdMAX SCNdPTR SCNi16 SCNi32 SCNi64 SCNi8 SCNiFAST16 "
    "SCNiFAST32 SCNiFAST64 SCNiFAST8 SCNiLEAST16 SCNiLEAST32 SCNiLEAST64 SCNiLEAST8 SCNiMAX SCNiPTR SCNo16 "
    "SCNo32 SCNo64 SCNo8 SCNoFAST16 SCNoFAST32 SCNoFAST64 SCNoFAST8 SCNoLEAST16 SCNoLEAST32 SCNoLEAST64 "
    "SCNoLEAST8 SCNoMAX SCNoPTR SCNu16 SCNu32 SCNu64 SCNu8 SCNuFAST16 SCNuFAST32 SCNuFAST64 SCNuFAST8 "
    "SCNuLEAST16 SCNuLEAST32 SCNuLEAST64 SCNuLEAST8 SCNuMAX SCNuPTR SCNx16 SCNx32 SCNx64 SCNx8 SCNxFAST16 "
    "SCNxFAST32 SCNxFAST64 SCNxFAST8 SCNxLEAST16 SCNxLEAST32 SCNxLEAST64 SCNxLEAST8 SCNxMAX SCNxPTR "
    "SEEK_CUR SEEK_DATA SEEK_END SEEK_HOLE SEEK_SET SEM_VALUE_MAX SHRT_MAX SHRT_MIN SHRT_WIDTH SIGABRT "
    "SIGALRM SIGBUS SIGCHLD SIGCLD SIGCONT SIGEV_NONE SIGEV_SIGNAL SIGEV_THREAD SIGEV_THREAD_ID SIGFPE "
    "SIGHUP SIGILL SIGINT SIGIO SIGIOT SIGKILL SIGPIPE SIGPOLL SIGPROF SIGPWR SIGQUIT SIGRTMAX SIGRTMIN "
    "SIGSEGV SIGSTKFLT SIGSTKSZ SIGSTOP SIGSYS SIGTERM SIGTRAP SIGTSTP SIGTTIN SIGTTOU SIGURG SIGUSR1 "
    "SIGUSR2 SIGVTALRM SIGWINCH SIGXCPU SIGXFSZ SIG_ATOMIC_MAX SIG_ATOMIC_MIN SIG_ATOMIC_WIDTH SIG_BLOCK "
    "SIG_DFL SIG_ERR SIG_HOLD SIG_IGN SIG_SETMASK SIG_UNBLOCK SIZE_MAX SIZE_WIDTH SSIZE_MAX STDERR_FILENO "
    "STDIN_FILENO STDOUT_FILENO TIME_UTC TMP_MAX TTY_NAME_MAX UCHAR_MAX UCHAR_WIDTH UINT16_C UINT16_MAX "
    "UINT16_WIDTH UINT32_C UINT32_MAX UINT32_WIDTH UINT64_C UINT64_MAX UINT64_WIDTH UINT8_C UINT8_MAX "
    "UINT8_WIDTH UINTMAX_C UINTMAX_MAX UINTMAX_WIDTH UINTPTR_MAX UINTPTR_WIDTH UINT_FAST16_MAX "
    "UINT_FAST16_WIDTH UINT_FAST32_MAX UINT_FAST32_WIDTH UINT_FAST64_MAX UINT_FAST64_WIDTH UINT_FAST8_MAX "
    "UINT_FAST8_WIDTH UINT_LEAST16_MAX UINT_LEAST16_WIDTH UINT_LEAST32_MAX UINT_LEAST32_WIDTH "
    "UINT_LEAST64_MAX UINT_LEAST64_WIDTH UINT_LEAST8_MAX UINT_LEAST8_WIDTH UINT_MAX UINT_WIDTH ULLONG_MAX "
    "ULLONG_WIDTH ULONG_LONG_MAX ULONG_MAX ULONG_WIDTH USHRT_MAX USHRT_WIDTH WCHAR_MAX WCHAR_MIN "
    "WCHAR_WIDTH WEOF WINT_MAX WINT_MIN WINT_WIDTH WNOHANG WNOWAIT WORD_BIT W_OK XATTR_LIST_MAX "
    "XATTR_NAME_MAX XATTR_SIZE_MAX X_OK alloca assert assert_perror errno issubnormal math_errhandling "
    "offsetof setjmp sigmask sigsetjmp stderr stdin stdout strdupa strndupa va_arg va_copy va_end va_star";

std::set<std::string, std::less<>> names_in(std::initializer_list<std::string_view> lists) {
    std::set<std::string, std::less<>> names;
    for (const std::string_view list : lists) {
        const std::vector<std::string> words = split(list, ' ');
        names.insert(words.begin(), words.end());
    }
    return names;
}

}  // namespace

bool is_reserved_name(std::string_view name) {
    static const std::set<std::string, std::less<>> reserved =
        names_in({kKeywords, kWindowsMacros, kXlibMacros, kStandardMacros});
    return reserved.contains(name);
}

bool is_global_name(std::string_view name) {
    static const std::set<std::string, std::less<>> global = names_in({global_names()});
    return global.contains(name);
}

}  // namespace gobo
